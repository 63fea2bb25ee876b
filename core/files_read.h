// What has been read since the program began: which files, and what they held. A checkpoint tells by it what has
// changed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string_view>

namespace dspm {

/// Tells texts apart that differ by accident; not for those who want to deceive.
std::uint64_t digest(std::string_view bytes);

/// By as many threads as like to. What was read first counts.
void note_file_read(const std::filesystem::path& path, std::string_view bytes);

/// The digest of each file, by its canonical path.
std::map<std::filesystem::path, std::uint64_t> files_read();

}  // namespace dspm
