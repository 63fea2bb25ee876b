// Reads grids of NanoVDB files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "dspm/media/sparse_grid.h"

namespace dspm {

/// Returns the grid of numbers of that name; nullopt if the file has none. Throws std::runtime_error if the file cannot be
/// read, or if dspm was built without NanoVDB.
std::optional<SparseGrid> read_nanovdb(const std::filesystem::path& file, const std::string& grid);

bool reads_nanovdb();

}  // namespace dspm
