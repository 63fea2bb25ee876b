// A whole file into memory; gzip-compressed ones are expanded, whatever their name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dspm {

/// Throws std::runtime_error with a sentence that does not name the file. "-" is standard input.
std::string read_file(const std::filesystem::path& path);

/// The data itself where it is not compressed; throws std::runtime_error where it is damaged or ends early.
std::string expand_gzip(std::string data);

}  // namespace dspm
