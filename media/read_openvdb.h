// Reads grids of OpenVDB files, by a module of its own: the library is large, and seldom needed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "dspm/media/sparse_grid.h"

namespace dspm {

/// Returns the grid of numbers of that name; nullopt if the file has none. Throws std::runtime_error if the file cannot be
/// read, or if the module is not there.
std::optional<SparseGrid> read_openvdb(const std::filesystem::path& file, const std::string& grid);

bool has_openvdb_module();
/// Returns an empty string if the module can be loaded, else the reason.
std::string fault_of_openvdb_module();

}  // namespace dspm
