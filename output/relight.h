// Mixes the light groups of an image again, without rendering: its light is the sum of that of its groups.
#pragma once

#include <filesystem>
#include <vector>

#include "dspm/output/group_factor.h"

namespace dspm {

/// Writes the image `from` (an EXR file with the outputs of all its light groups) anew as `to`, with the light of these
/// groups multiplied, in radiance and in their own layers; everything else stays. Throws UsageError if it has no such
/// group or lacks the output of one, other std::exceptions if a file cannot be read or written.
void relight(const std::filesystem::path& from, const std::vector<GroupFactor>& factors,
             const std::filesystem::path& to);

}  // namespace dspm
