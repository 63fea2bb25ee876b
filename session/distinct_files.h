// No file of a run may replace another one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dspm {

struct NamedFile {
  std::filesystem::path path;
  std::string what;  // "the video"
};

/// Returns whether both names mean the same file, however they are spelled, and whether or not it exists.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Throws UsageError, naming both, if a file is written under two names or is both read and written.
void expect_distinct(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written);

}  // namespace dspm
