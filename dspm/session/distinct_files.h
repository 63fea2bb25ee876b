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

/// Whatever the spelling, and whether it exists.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Throws UsageError where one that is written is another one, or one that is read, and names both.
void expect_distinct(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written);

}  // namespace dspm
