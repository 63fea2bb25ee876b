// Tells whether an .mp4 was written completely.
#pragma once

#include <filesystem>

namespace dspm {

/// Returns whether the file is a row of boxes up to its very end, among them the film's index and its data. [ISO/IEC
/// 14496-12, 4.2]
bool is_whole_mp4(const std::filesystem::path& path);

}  // namespace dspm
