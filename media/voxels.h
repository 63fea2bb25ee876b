// Values on a grid, linear in between, and 0 outside.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "dspm/base/math/vec.h"

namespace dspm {

template <class T>
class Voxels {
 public:
  Voxels() = default;
  /// `values` has x fastest and z slowest; each stands in the middle of its cell.
  Voxels(std::array<int, 3> counts, std::vector<T> values) : counts_(counts), values_(std::move(values)) {}

  bool empty() const { return values_.empty(); }

  /// Returns the value at a place in [0, 1]^3.
  T at(const Vec3& place) const {
    const Axis x(place.x, counts_[0]), y(place.y, counts_[1]), z(place.z, counts_[2]);
    T sum{};
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
          if (const float share = x.share(i) * y.share(j) * z.share(k); share > 0)
            sum += share * value(x.index + i, y.index + j, z.index + k);
    return sum;
  }

  /// Calls fn(const T&) for each value that has a share in a place of that box.
  template <class Fn>
  void for_each_in(const Bounds3& places, Fn&& fn) const {
    const auto range = [](float low, float high, int count) {
      return std::pair(std::clamp(Axis(low, count).index, 0, count), std::clamp(Axis(high, count).index + 2, 0, count));
    };
    const auto [x0, x1] = range(places.low.x, places.high.x, counts_[0]);
    const auto [y0, y1] = range(places.low.y, places.high.y, counts_[1]);
    const auto [z0, z1] = range(places.low.z, places.high.z, counts_[2]);
    for (int z = z0; z < z1; ++z)
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) fn(value(x, y, z));
  }

 private:
  /// Along one axis: the cell whose middle is at or before the place, and how far the place is from there to the next.
  struct Axis {
    int index;
    float rest;

    Axis(float place, int count) {
      const float cells = std::clamp(place, -1.f, 2.f) * static_cast<float>(count) - 0.5f, below = std::floor(cells);
      index = static_cast<int>(below), rest = cells - below;
    }
    float share(int next) const { return next != 0 ? rest : 1 - rest; }
  };

  T value(int x, int y, int z) const {
    if (x < 0 || y < 0 || z < 0 || x >= counts_[0] || y >= counts_[1] || z >= counts_[2]) return T{};
    return values_[(static_cast<std::size_t>(z) * static_cast<std::size_t>(counts_[1]) + static_cast<std::size_t>(y)) *
                       static_cast<std::size_t>(counts_[0]) +
                   static_cast<std::size_t>(x)];
  }

  std::array<int, 3> counts_{};
  std::vector<T> values_;
};

}  // namespace dspm
