// The cells of a uniform grid of points, as a plain value that devices can have.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// Truncates to at least 0; NaN, which huge coordinates can cause, becomes 0.
constexpr int truncated(float v, float most) { return static_cast<int>(std::min(std::max(0.f, v), most)); }

struct GridCells {
  struct Cell {
    int x, y, z;
  };

  Bounds3 bounds;
  float inverse_cell = 1;
  int nx = 0, ny = 0, nz = 0;

  /// Returns the cell of a point, clamped into the grid.
  constexpr Cell cell_of(const Vec3& p) const {
    const Vec3 c = (p - bounds.low) * inverse_cell;
    const auto along = [](float v, int n) { return truncated(v, static_cast<float>(n - 1)); };
    return {along(c.x, nx), along(c.y, ny), along(c.z, nz)};
  }
  constexpr std::size_t index_of(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(x);
  }

  /// Calls fn(first place, place after the last) for each row of cells, which are neighbours along x, in which points within
  /// sqrt(radius2) of p may lie. Points are sorted by cell, and those of cell c begin at begins[c].
  template <class Fn>
  constexpr void for_each_row(const std::uint32_t* begins, const Vec3& p, float radius2, Fn&& fn) const {
    // Rounded outward, so that no cell is skipped whose points would pass the distance test.
    const float radius = rounded::sqrt(radius2) * (1 + 0x1p-20f);
    const Vec3 reach = Vec3{radius, radius, radius} + abs(p) * 0x1p-21f, from = p - reach, to = p + reach;
    if (!(to.x >= bounds.low.x && from.x <= bounds.high.x && to.y >= bounds.low.y && from.y <= bounds.high.y &&
          to.z >= bounds.low.z && from.z <= bounds.high.z))
      return;
    const Cell low = cell_of(from), high = cell_of(to);
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y) fn(begins[index_of(low.x, y, z)], begins[index_of(high.x, y, z) + 1]);
  }
};

/// A PointGrid as devices have it.
struct PlainGrid {
  GridCells cells;
  const std::uint32_t* begins = nullptr;  // by cell, and one past the last
  const float *x = nullptr, *y = nullptr, *z = nullptr;  // of the points, and kPadding more
  std::size_t cell_count = 0, point_count = 0;

  static constexpr std::uint32_t kAtOnce = 4, kPadding = kAtOnce - 1;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(begins, point_count == 0 ? 0 : cell_count + 1);
    const std::size_t padded = point_count == 0 ? 0 : point_count + kPadding;
    fn(x, padded), fn(y, padded), fn(z, padded);
  }

  constexpr Vec3 point(std::uint32_t place) const { return {x[place], y[place], z[place]}; }

  /// Does what PointGrid::for_each_within() does.
  template <class Fn>
  constexpr std::uint64_t for_each_within(const Vec3& p, float radius2, Fn&& fn) const {
    std::uint64_t tested = 0;
    if (point_count == 0) return tested;
    cells.for_each_row(begins, p, radius2, [&](std::uint32_t begin, std::uint32_t end) {
      tested += end - begin;
      for (std::uint32_t first = begin; first < end; first += kAtOnce) {
        float distance2[kAtOnce];  // side by side on a CPU
        for (std::uint32_t i = 0; i < kAtOnce; ++i) {
          const float dx = x[first + i] - p.x, dy = y[first + i] - p.y, dz = z[first + i] - p.z;
          distance2[i] = dx * dx + dy * dy + dz * dz;
        }
        for (std::uint32_t i = 0; i < kAtOnce && first + i < end; ++i)
          if (distance2[i] <= radius2) fn(first + i, distance2[i]);
      }
    });
    return tested;
  }
};

}  // namespace dspm
