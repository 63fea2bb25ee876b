// The files read since the program began, and digests of their contents. A checkpoint uses them to detect changes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string_view>

namespace dspm {

/// Detects accidental differences; not safe against deliberate ones.
std::uint64_t digest(std::string_view bytes);

/// Thread-safe. The first read of a file counts.
void note_file_read(const std::filesystem::path& path, std::string_view bytes);

/// From here on, the next read of each file counts.
void forget_files_read();

/// The digest of each file, by its canonical path.
std::map<std::filesystem::path, std::uint64_t> files_read();

}  // namespace dspm
