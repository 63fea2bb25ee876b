// Reads whole files into memory; every file that dspm reads comes in here. Their size is bounded, so that neither a
// device nor a few bytes of gzip exhaust the machine's memory.
#pragma once

#include <filesystem>
#include <string>

namespace dspm {

/// Reads a file unchanged. Throws std::runtime_error with a sentence that does not name the file.
std::string read_bytes(const std::filesystem::path& path);
/// Reads a file that is no part of the scene: files_read() will not name it.
std::string read_other_bytes(const std::filesystem::path& path);

/// Reads a file and expands it if it is gzip-compressed, whatever its name.
std::string read_file(const std::filesystem::path& path);

/// Reads a file like read_file(); "-" is standard input.
std::string read_input(const std::string& name);

/// Returns the data itself if it is not compressed; throws std::runtime_error if it is damaged, ends early or expands
/// too much.
std::string expand_gzip(std::string data);

}  // namespace dspm
