// Directional albedos: which share of the light from one direction a lobe sends anywhere, by that direction's cosine
// and the lobe's alpha. Layers give what one lobe leaves to the next, so that together they scatter all light, once.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "dspm/materials/table_place.h"

namespace dspm {

class AlbedoTable {
 public:
  /// Calls `albedo(cos, alpha)` for cosines in (0, 1] and alphas in [0, 1].
  template <class Fn>
  explicit AlbedoTable(Fn&& albedo) {
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column)
        at(row, column) = std::clamp(albedo(cosine(column), TablePlace::value(row, kRows)), 0.f, 1.f);
    find_means();
  }

  /// Interpolates linearly between the table's entries, which lie closer for small cosines and alphas.
  constexpr float of(float cos, float alpha) const {
    const TablePlace row(alpha, kRows), column(cos, kColumns);
    const auto in_row = [&](int r) { return column.between(at(r, column.first), at(r, column.first + 1)); };
    return row.between(in_row(row.first), in_row(row.first + 1));
  }
  /// Returns the albedo of diffuse light: 2 times the integral of albedo times cosine.
  constexpr float mean(float alpha) const {
    const TablePlace row(alpha, kRows);
    return row.between(means_[static_cast<std::size_t>(row.first)], means_[static_cast<std::size_t>(row.first) + 1]);
  }

 private:
  static constexpr int kRows = 24, kColumns = 32;
  static constexpr float kLeastCosine = 1e-3f;

  static constexpr float cosine(int column) { return std::max(TablePlace::value(column, kColumns), kLeastCosine); }

  constexpr float& at(int row, int column) { return values_[static_cast<std::size_t>(row * kColumns + column)]; }
  constexpr float at(int row, int column) const { return values_[static_cast<std::size_t>(row * kColumns + column)]; }

  void find_means() {
    constexpr int kSteps = 400;
    for (int row = 0; row < kRows; ++row) {
      double sum = 0;
      for (int i = 0; i < kSteps; ++i) {
        const float cos = (static_cast<float>(i) + 0.5f) / kSteps;
        sum += static_cast<double>(of(cos, TablePlace::value(row, kRows)) * cos);
      }
      means_[static_cast<std::size_t>(row)] = static_cast<float>(2 * sum / kSteps);
    }
  }

  std::array<float, kRows * kColumns> values_;
  std::array<float, kRows> means_;
};

}  // namespace dspm
