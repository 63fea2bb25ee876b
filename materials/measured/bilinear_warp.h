// Densities over the unit square that are bilinear between the nodes of a grid, and change with two parameters: there
// is one grid for each pair of parameter values, linear in between. [Dupuy and Jakob 2018, supplement]
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "dspm/base/math/vec.h"

namespace dspm {

/// Four grids and their weights.
struct GridMix {
  std::array<std::size_t, 4> grid{};
  std::array<float, 4> weight{1, 0, 0, 0};
};

/// The values of both parameters for which there are grids, ascending; the second parameter's lie next to each other.
class GridParameters {
 public:
  GridParameters(std::vector<float> first, std::vector<float> second)
      : first_(std::move(first)), second_(std::move(second)) {}
  /// Returns the grids for a pair of parameters. Beyond the first and last value, these hold.
  GridMix at(float first, float second) const;
  std::size_t count() const { return first_.size() * second_.size(); }

 private:
  std::vector<float> first_, second_;
};

/// The nodes around a point of the unit square.
struct GridPlace {
  int x, y;
  float tx, ty;

  GridPlace(const Vec2& p, int width, int height);
  /// Interpolates a value at the nodes: value(x, y).
  template <class Value>
  auto interpolate(Value&& value) const {
    return (value(x, y) * (1 - tx) + value(x + 1, y) * tx) * (1 - ty) +
           (value(x, y + 1) * (1 - tx) + value(x + 1, y + 1) * tx) * ty;
  }
};

class BilinearWarp {
 public:
  /// Takes rows of `width` values, `height` of them for each grid; neither negative nor infinite, and with a positive
  /// integral. There must be at least 2 x 2.
  BilinearWarp(std::span<const float> values, int width, int height);

  struct Point {
    Vec2 p;
    float density;  // at the warped point
  };
  /// Warps uniform numbers.
  Point sample(const Vec2& u, const GridMix& mix) const;
  /// Returns the numbers for which sample() gives p.
  Point invert(const Vec2& p, const GridMix& mix) const;
  float density(const Vec2& p, const GridMix& mix) const;

 private:
  float value(int x, int y, const GridMix& mix) const { return mixed(values_, index(x, y), cells(), mix); }
  /// Returns the integral of the row of nodes up to x.
  float row_until(int x, int y, const GridMix& mix) const { return mixed(rows_, index(x, y), cells(), mix); }
  float row(int y, const GridMix& mix) const { return row_until(width_ - 1, y, mix); }
  /// Returns the integral of all that is below the row of nodes.
  float below(int y, const GridMix& mix) const {
    return mixed(below_, static_cast<std::size_t>(y), static_cast<std::size_t>(height_), mix);
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  std::size_t cells() const { return index(0, height_); }
  static float mixed(const std::vector<float>& of, std::size_t index, std::size_t size, const GridMix& mix) {
    float sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
      if (mix.weight[k] != 0) sum += mix.weight[k] * of[mix.grid[k] * size + index];
    return sum;
  }

  int width_, height_;
  std::vector<float> values_, rows_, below_;  // by grid; their integrals are 1
};

}  // namespace dspm
