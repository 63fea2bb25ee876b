// Tables as text: spectra, and what sensors respond to.
#pragma once

#include <filesystem>
#include <vector>

namespace dspm {

/// Reads the numbers of a text file, between white space or commas, with # comments. Throws std::runtime_error, which does
/// not name the file, if it holds anything else.
std::vector<float> read_numbers(const std::filesystem::path& path);

}  // namespace dspm
