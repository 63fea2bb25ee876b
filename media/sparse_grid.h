// Numbers on a sparse grid, as files of volumes hold them: blocks of 8 x 8 x 8, and one number everywhere else.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"

namespace dspm {

class SparseGrid {
 public:
  static constexpr int kSide = 8, kValues = kSide * kSide * kSide;
  using Index = std::array<int, 3>;

  /// An empty grid for blocks whose first voxels are from `low` to `high`, all multiples of 8. `to_medium` maps voxel
  /// coordinates to the medium's space; the value of a voxel is that at its whole coordinates. Throws std::runtime_error if
  /// there are too many.
  SparseGrid(const Index& low, const Index& high, const Transform& to_medium);

  /// Sets the values of a block, x slowest and z fastest.
  void set_block(const Index& first, const float* values);
  /// Sets one value for all blocks from `first` on that lie within `size` voxels along each axis.
  void set_blocks(const Index& first, int size, float value);

  /// Returns the value at a point of the medium's space, linear between voxels.
  float at(const Vec3& p) const;
  /// Returns the largest value that any point of a box of the medium's space may have.
  float largest_in(const Bounds3& box) const;
  /// The box, in the medium's space, outside of which all is 0.
  Bounds3 extent() const;

 private:
  static constexpr std::uint32_t kEmpty = ~std::uint32_t{0};

  std::size_t block_at(int x, int y, int z) const {
    return (static_cast<std::size_t>(x) * static_cast<std::size_t>(counts_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(counts_[2]) +
           static_cast<std::size_t>(z);
  }
  float value(int x, int y, int z) const;
  float largest_of_block(int x, int y, int z) const;
  /// Returns the first of eight neighbouring voxels that lie in one block, null if it is empty; nullopt if they lie in several.
  std::optional<const float*> within_block(int x, int y, int z) const;
  /// Interpolates between a voxel and its seven neighbours in a block.
  static float interpolated(const float* first, const Vec3& rest);

  Index low_, counts_;  // of the first block, and numbers of blocks
  Transform to_medium_;
  std::vector<std::uint32_t> blocks_;    // into values_ / kValues
  std::vector<float> values_, largest_;  // by block
};

}  // namespace dspm
