// Files that lie inside others, as if those were folders: "shoe.glb/seat.ply". Whoever reads the outer file offers them;
// read_bytes finds them, and they are made when they are read.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace dspm {

/// Thread-safe. May throw std::runtime_error with a sentence that does not name the file. A file that is offered again
/// is replaced.
void offer_inner_file(const std::filesystem::path& path, std::function<std::string()> bytes);

bool is_inner_file(const std::filesystem::path& path);
/// Nullopt if nobody has offered it.
std::optional<std::string> inner_file(const std::filesystem::path& path);

}  // namespace dspm
