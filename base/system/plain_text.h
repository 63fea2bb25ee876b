// Text files as programs write them. Every reader of a text format takes its text from here, so none meets a byte order
// mark, a carriage return or UTF-16.
#pragma once

#include <filesystem>
#include <string>

namespace dspm {

/// Returns the text without byte order mark, whose lines end with \n, whether they ended with \n, \r\n or \r. Throws
/// std::runtime_error if it is UTF-16 or UTF-32.
std::string plain_text(std::string text);

/// Returns plain_text() of read_file().
std::string read_text(const std::filesystem::path& path);

}  // namespace dspm
