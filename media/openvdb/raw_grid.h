// What the module that reads OpenVDB files hands over: plain values, so that it needs nothing of the library that loads it.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace dspm {

struct RawGrid {
  using Index = std::array<int, 3>;
  static constexpr int kLeafSide = 8;

  struct Tile {  // a cube of voxels of one value
    Index first;
    int size;
    float value;
  };
  std::vector<Tile> tiles;
  std::vector<Index> leaves;                // the first voxel of each
  std::vector<float> values;                // of the leaves, one after another, z fastest
  std::array<double, 12> world_from_index;  // by rows of four
};

/// Returns the grid of that name, which the caller then owns; null if the file has none. Throws std::runtime_error if it cannot
/// be read.
using ReadOpenVdb = RawGrid*(const std::string& file, const std::string& grid);

}  // namespace dspm
