// How images are called whose lights are mixed again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dspm {

/// As the EXR files `images` were named by their renders: after variations, with numbers only if several moments are among
/// them. Images that their headers do not tell apart are numbered in their order. Throws UsageError and what reading
/// headers throws.
std::vector<std::filesystem::path> relit_names(const std::vector<std::filesystem::path>& images,
                                               const std::string& pattern);

}  // namespace dspm
