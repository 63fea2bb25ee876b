// Directional albedos of facets that are rougher along the first tangent than along the second. AlbedoTable holds those
// of facets that are equally rough.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/table_place.h"

namespace dspm {

class BrushedAlbedo {
 public:
  /// Calls `albedo(o, facets)` for directions in a quarter of the hemisphere.
  template <class Fn>
  explicit BrushedAlbedo(Fn&& albedo) {
    for (int narrow = 0; narrow < kNarrow; ++narrow)
      for (int row = 0; row < kRows; ++row) {
        const float alpha = TablePlace::value(row, kRows), across = alpha * square(aspect(narrow));
        const Ggx facets({alpha, across});
        for (int turn = 0; turn < kTurns; ++turn)
          for (int column = 0; column < kColumns; ++column)
            at(narrow, row, turn, column) = std::clamp(
                albedo(direction(std::max(TablePlace::value(column, kColumns), 1e-3f), turn, facets), facets), 0.f,
                1.f);
        means_[static_cast<std::size_t>(narrow * kRows + row)] = mean_in(narrow, row, facets.alpha());
      }
  }

  BrushedAlbedo(const BrushedAlbedo& a, const BrushedAlbedo& b, float share) : BrushedAlbedo(a) {
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] += share * (b.values_[i] - a.values_[i]);
    for (std::size_t i = 0; i < means_.size(); ++i) means_[i] += share * (b.means_[i] - a.means_[i]);
  }

  /// Returns a direction's azimuth, 0 along the rough tangent and 1 across, spaced evenly where albedos change.
  static constexpr float turn(const Vec3& w, Vec2 alpha) {
    const float along = std::abs(w.x) * rounded::sqrt(alpha.x), across = std::abs(w.y) * rounded::sqrt(alpha.y);
    return along + across > 0 ? rounded::atan2(across, along) * 2 / kPi : 0.5f;
  }

  /// Interpolates linearly between the table's entries. alpha.x must be the greater.
  constexpr float of(float cos, float turn, Vec2 alpha) const {
    const Where where(alpha);
    return where.between([&](int narrow, int row) { return in_row(narrow, row, cos, turn); });
  }
  /// Returns the albedo of diffuse light.
  constexpr float mean(Vec2 alpha) const {
    const Where where(alpha);
    return where.between([&](int narrow, int row) { return means_[static_cast<std::size_t>(narrow * kRows + row)]; });
  }

 private:
  // Of square roots of alpha.y / alpha.x from 1 down, alpha.x, azimuths and cosines.
  static constexpr int kNarrow = 7, kRows = 10, kTurns = 6, kColumns = 16;
  static constexpr float kLeastAspect = 0.03162278f;  // of the roughest facets over the smoothest

  static constexpr float square(float x) { return x * x; }
  static constexpr float aspect(int narrow) {
    return 1 - (1 - kLeastAspect) * static_cast<float>(narrow) / (kNarrow - 1);
  }

  struct Where {
    int narrow;
    float further;
    TablePlace row;
    constexpr explicit Where(Vec2 alpha) : row(alpha.x, kRows) {
      const float aspect = rounded::sqrt(std::min(1.f, alpha.y / alpha.x));
      const float x = std::min(1.f, (1 - aspect) / (1 - kLeastAspect)) * (kNarrow - 1);
      narrow = std::min(static_cast<int>(x), kNarrow - 2), further = x - static_cast<float>(narrow);
    }
    template <class Fn>
    constexpr float between(const Fn& fn) const {
      const auto at = [&](int n) { return row.between(fn(n, row.first), fn(n, row.first + 1)); };
      const float from = at(narrow);
      return from + further * (at(narrow + 1) - from);
    }
  };

  constexpr float in_row(int narrow, int row, float cos, float turn) const {
    const TablePlace column(cos, kColumns);
    const float x = turn * (kTurns - 1);
    const int first = std::min(static_cast<int>(x), kTurns - 2);
    const auto at_turn = [&](int t) {
      return column.between(at(narrow, row, t, column.first), at(narrow, row, t, column.first + 1));
    };
    const float from = at_turn(first);
    return from + (x - static_cast<float>(first)) * (at_turn(first + 1) - from);
  }

  static Vec3 direction(float cos, int turn, const Ggx& facets) {
    const float angle = static_cast<float>(turn) / (kTurns - 1) * kPi / 2;
    const Vec2 alpha = facets.alpha();
    const float x = rounded::cos(angle) / rounded::sqrt(alpha.x), y = rounded::sin(angle) / rounded::sqrt(alpha.y);
    const float scale = rounded::sqrt((1 - cos * cos) / (x * x + y * y));
    return {x * scale, y * scale, cos};
  }

  float mean_in(int narrow, int row, Vec2 alpha) const {
    constexpr int kUp = 100, kAround = 16;
    double sum = 0;
    for (int i = 0; i < kUp; ++i)
      for (int j = 0; j < kAround; ++j) {
        const float cos = (static_cast<float>(i) + 0.5f) / kUp;
        const float phi = (static_cast<float>(j) + 0.5f) / kAround * kPi / 2;
        sum +=
            static_cast<double>(cos * in_row(narrow, row, cos, turn({rounded::cos(phi), rounded::sin(phi), 0}, alpha)));
      }
    return static_cast<float>(2 * sum / (kUp * kAround));
  }

  static constexpr std::size_t index(int narrow, int row, int turn, int column) {
    return static_cast<std::size_t>(((narrow * kRows + row) * kTurns + turn) * kColumns + column);
  }
  constexpr float& at(int narrow, int row, int turn, int column) { return values_[index(narrow, row, turn, column)]; }
  constexpr float at(int narrow, int row, int turn, int column) const {
    return values_[index(narrow, row, turn, column)];
  }

  std::array<float, kNarrow * kRows * kTurns * kColumns> values_;
  std::array<float, kNarrow * kRows> means_;
};

}  // namespace dspm
