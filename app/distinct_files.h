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

/// Throws UsageError where two are the same file, whatever the spelling, and names both.
void expect_distinct(const std::vector<NamedFile>& files);

}  // namespace dspm
