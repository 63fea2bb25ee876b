// Points in a uniform grid, sorted by cell, for finding all points within a radius. Knows no rendering.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace dspm {

/// Cells of one row (neighbours along x) lie behind one another in memory, so a query walks a few contiguous runs.
class PointGrid {
 public:
  /// Sorts `points` by cell; points of a cell stay in their order. Cells are `cell_size` wide, or wider where that would
  /// make more than a few cells a point. `points` is not kept.
  void build(std::span<const Vec3> points, float cell_size);

  /// Place i of the sorted order holds point order()[i].
  std::span<const std::uint32_t> order() const { return order_; }
  std::size_t bytes() const;

  /// Calls fn(i, distance squared) for every place i of the sorted order whose point lies within `radius` of p, in
  /// ascending order of i within a row of cells and of rows. Returns how many points were tested.
  template <class Fn>
  std::uint64_t for_each_within(const Vec3& p, float radius, Fn&& fn) const;

 private:
  struct Cell {
    int x, y, z;
  };
  Cell cell_of(const Vec3& p) const;  // clamped into the grid
  std::size_t index_of(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny_) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(nx_) + static_cast<std::size_t>(x);
  }

  Bounds3 bounds_;
  float inverse_cell_ = 1;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<std::uint32_t> begin_;  // of each cell in the sorted order, and one past the last
  std::vector<std::uint32_t> order_, cell_;
  std::vector<float> x_, y_, z_;      // of the sorted points
};

template <class Fn>
std::uint64_t PointGrid::for_each_within(const Vec3& p, float radius, Fn&& fn) const {
  if (order_.empty()) return 0;
  const Vec3 reach{radius, radius, radius};
  if (!(p.x + radius >= bounds_.low.x && p.x - radius <= bounds_.high.x && p.y + radius >= bounds_.low.y &&
        p.y - radius <= bounds_.high.y && p.z + radius >= bounds_.low.z && p.z - radius <= bounds_.high.z))
    return 0;
  const Cell low = cell_of(p - reach), high = cell_of(p + reach);
  const float radius2 = radius * radius;
  std::uint64_t tested = 0;
  constexpr std::uint32_t kBlock = 256;
  std::uint32_t within[kBlock];
  float distance2[kBlock];
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y) {
      const std::uint32_t end = begin_[index_of(high.x, y, z) + 1];
      for (std::uint32_t block = begin_[index_of(low.x, y, z)]; block < end; block += kBlock) {
        const std::uint32_t block_end = std::min(end, block + kBlock);
        std::uint32_t found = 0;
        // Without a branch: about one point in three is near enough, in no order that a processor could predict.
        for (std::uint32_t i = block; i < block_end; ++i) {
          const float dx = x_[i] - p.x, dy = y_[i] - p.y, dz = z_[i] - p.z;
          const float d2 = dx * dx + dy * dy + dz * dz;
          within[found] = i, distance2[found] = d2;
          found += d2 <= radius2;
        }
        for (std::uint32_t k = 0; k < found; ++k) fn(within[k], distance2[k]);
        tested += block_end - block;
      }
    }
  return tested;
}

}  // namespace dspm
