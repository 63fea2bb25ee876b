// Mesh files as bytes.
#pragma once

#include <filesystem>
#include <string>

namespace dspm {

/// The whole file, expanded where it is gzip-compressed. Throws std::runtime_error with a sentence that does not name
/// it.
std::string read_mesh_file(const std::filesystem::path& path);

}  // namespace dspm
