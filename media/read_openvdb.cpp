#include "dspm/media/read_openvdb.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "dspm/base/system/beside_library.h"
#include "dspm/media/grid_parts.h"
#include "dspm/media/openvdb/raw_grid.h"

namespace dspm {
namespace {

std::filesystem::path module_file() { return beside_library(DSPM_OPENVDB_MODULE); }

/// Returns null if the module cannot be loaded, for the reason that dlerror() gives.
ReadOpenVdb* load_module() {
  void* const module = dlopen(module_file().c_str(), RTLD_NOW | RTLD_LOCAL);
  return module != nullptr ? reinterpret_cast<ReadOpenVdb*>(dlsym(module, "dspm_read_openvdb")) : nullptr;
}

Transform placement(const RawGrid& grid) {
  Matrix4 matrix;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column) matrix.m[row][column] = grid.world_from_index[4 * row + column];
  return Transform(matrix);
}

std::vector<GridPart> parts_of(const RawGrid& grid) {
  static_assert(RawGrid::kLeafSide == SparseGrid::kSide);
  std::vector<GridPart> parts;
  for (std::size_t i = 0; i < grid.leaves.size(); ++i)
    parts.push_back({grid.leaves[i], SparseGrid::kSide, 0, grid.values.data() + i * SparseGrid::kValues});
  for (const RawGrid::Tile& tile : grid.tiles)
    if (tile.value != 0) parts.push_back({tile.first, tile.size, tile.value, nullptr});
  return parts;
}

}  // namespace

std::optional<SparseGrid> read_openvdb(const std::filesystem::path& file, const std::string& grid) try {
  ReadOpenVdb* const read = load_module();
  if (read == nullptr)
    throw std::runtime_error(
        fmt::format("dspm's module for OpenVDB {}; build dspm where Debian's libopenvdb-dev is "
                    "installed, or make a .nvdb file of it with nanovdb_convert",
                    has_openvdb_module() ? fmt::format("cannot be loaded ({})", dlerror()) : "is not there"));
  const std::unique_ptr<const RawGrid> raw(read(file.string(), grid));
  if (raw == nullptr) return std::nullopt;
  return grid_of(parts_of(*raw), placement(*raw));
} catch (const std::bad_alloc&) {
  throw std::runtime_error("it is damaged, or larger than the memory");
} catch (const std::invalid_argument&) {
  throw std::runtime_error("its placement has no inverse");
}

bool has_openvdb_module() {
  std::error_code none;
  return std::filesystem::exists(module_file(), none);
}

std::string fault_of_openvdb_module() { return load_module() != nullptr ? "" : dlerror(); }

}  // namespace dspm
