#include "dspm/media/read_nanovdb.h"

#include <stdexcept>

#ifdef DSPM_NANOVDB
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridHandle.h>
#include <nanovdb/util/IO.h>

#include <cstdint>
#include <sstream>
#include <vector>

#include "dspm/base/system/read_file.h"
#include "dspm/media/grid_parts.h"
#endif

namespace dspm {

#ifdef DSPM_NANOVDB

namespace {

using Index = SparseGrid::Index;
using Grid = nanovdb::NanoGrid<float>;
using Root = nanovdb::NanoRoot<float>;
using Upper = nanovdb::NanoUpper<float>;
using Lower = nanovdb::NanoLower<float>;
using Leaf = nanovdb::NanoLeaf<float>;

constexpr int kLowerSide = 128, kUpperSide = 4096;  // in voxels

/// Walks through a grid's tree. Places in a damaged file may point anywhere, so each is checked.
class TreeWalk {
 public:
  TreeWalk(const void* grid, std::size_t size) : begin_(static_cast<const char*>(grid)), end_(begin_ + size) {}

  std::vector<GridPart> parts() {
    const auto* grid = expect<nanovdb::GridData>(begin_);
    const char* const tree = begin_ + sizeof(nanovdb::GridData);
    const auto* nodes = expect<nanovdb::TreeData<3>>(tree);
    const auto* root = expect<Root::DataType>(tree + offset(nodes->mNodeOffset[3]));
    if (grid->mGridType != nanovdb::GridType::Float)
      throw std::runtime_error("its values are not plain numbers (float)");
    const char* tile = reinterpret_cast<const char*>(root) + sizeof(Root::DataType);
    for (std::uint32_t i = 0; i < root->mTableSize; ++i, tile += sizeof(Root::DataType::Tile)) {
      const auto* each = expect<Root::DataType::Tile>(tile);
      const nanovdb::Coord first = each->origin();
      const Index at{first[0], first[1], first[2]};
      if (each->isChild())
        add_upper(reinterpret_cast<const char*>(root) + offset(static_cast<std::uint64_t>(each->child)), at);
      else if (each->value != 0)
        throw std::runtime_error("it has a region of 4096 voxels' width of one value");
    }
    return std::move(parts_);
  }

 private:
  template <class T>
  const T* expect(const char* at) const {
    if (at < begin_ || at > end_ || static_cast<std::size_t>(end_ - at) < sizeof(T) ||
        reinterpret_cast<std::uintptr_t>(at) % alignof(T) != 0)
      throw std::runtime_error("it is damaged");
    return reinterpret_cast<const T*>(at);
  }
  std::ptrdiff_t offset(std::uint64_t bytes) const {
    if (bytes > static_cast<std::uint64_t>(end_ - begin_)) throw std::runtime_error("it is damaged");
    return static_cast<std::ptrdiff_t>(bytes);
  }
  static Index inner(const Index& first, std::uint32_t n, int log2, int side) {
    const int mask = (1 << log2) - 1;
    const auto i = static_cast<int>(n);
    return {first[0] + (i >> (2 * log2)) * side, first[1] + ((i >> log2) & mask) * side, first[2] + (i & mask) * side};
  }

  void add_upper(const char* at, const Index& first) {
    const auto* node = expect<Upper::DataType>(at);
    for (std::uint32_t n = 0; n < Upper::SIZE; ++n) {
      const Index place = inner(first, n, 5, kLowerSide);
      if (node->mChildMask.isOn(n))
        add_lower(at + offset(static_cast<std::uint64_t>(node->mTable[n].child)), place);
      else if (node->mTable[n].value != 0)
        parts_.push_back({place, kLowerSide, node->mTable[n].value, nullptr});
    }
  }
  void add_lower(const char* at, const Index& first) {
    const auto* node = expect<Lower::DataType>(at);
    for (std::uint32_t n = 0; n < Lower::SIZE; ++n) {
      const Index place = inner(first, n, 4, SparseGrid::kSide);
      if (node->mChildMask.isOn(n)) {
        const auto* leaf = expect<Leaf::DataType>(at + offset(static_cast<std::uint64_t>(node->mTable[n].child)));
        parts_.push_back({place, SparseGrid::kSide, 0, leaf->mValues});
      } else if (node->mTable[n].value != 0) {
        parts_.push_back({place, SparseGrid::kSide, node->mTable[n].value, nullptr});
      }
    }
  }

  const char *begin_, *end_;
  std::vector<GridPart> parts_;
};

Transform placement(const nanovdb::Map& map) {
  Matrix4 matrix;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) matrix.m[row][column] = map.mMatD[3 * row + column];
    matrix.m[row][3] = map.mVecD[row];
  }
  return Transform(matrix);
}

}  // namespace

std::optional<SparseGrid> read_nanovdb(const std::filesystem::path& file, const std::string& grid) try {
  std::istringstream in(read_file(file));
  const auto handle = nanovdb::io::readGrid(in, grid);
  if (!handle) return std::nullopt;
  return grid_of(TreeWalk(handle.data(), handle.size()).parts(),
                 placement(reinterpret_cast<const nanovdb::GridData*>(handle.data())->mMap));
} catch (const std::bad_alloc&) {
  throw std::runtime_error("it is damaged, or larger than the memory");
} catch (const std::invalid_argument&) {
  throw std::runtime_error("its placement has no inverse");
}

bool reads_nanovdb() { return true; }

#else

bool reads_nanovdb() { return false; }

std::optional<SparseGrid> read_nanovdb(const std::filesystem::path&, const std::string&) {
  throw std::runtime_error("dspm was built without NanoVDB (Debian's libnanovdb-dev)");
}

#endif

}  // namespace dspm
