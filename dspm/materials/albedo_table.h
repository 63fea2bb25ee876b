// Directional albedos: which share of the light from one direction a lobe sends anywhere, by that direction's cosine and
// the lobe's alpha. Layers give what one lobe leaves to the next, so that together they scatter all light, once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace dspm {

class AlbedoTable {
 public:
  /// `albedo(cos, alpha)` is called for cosines in (0, 1] and alphas in [0, 1].
  template <class Fn>
  explicit AlbedoTable(Fn&& albedo) {
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column)
        at(row, column) = std::clamp(albedo(cosine(column), square(row, kRows)), 0.f, 1.f);
    find_means();
  }

  /// Linear between its entries, which lie closer for small cosines and alphas.
  float of(float cos, float alpha) const {
    const Place row(alpha, kRows), column(cos, kColumns);
    const auto in_row = [&](int r) { return column.between(at(r, column.first), at(r, column.first + 1)); };
    return row.between(in_row(row.first), in_row(row.first + 1));
  }
  /// Of diffuse light: 2 times the integral of albedo times cosine.
  float mean(float alpha) const {
    const Place row(alpha, kRows);
    return row.between(means_[static_cast<std::size_t>(row.first)], means_[static_cast<std::size_t>(row.first) + 1]);
  }

 private:
  static constexpr int kRows = 24, kColumns = 32;
  static constexpr float kLeastCosine = 1e-3f;

  struct Place {
    int first;
    float fraction;
    Place(float value, int count) {
      const float x = std::sqrt(std::clamp(value, 0.f, 1.f)) * static_cast<float>(count - 1);
      first = std::min(static_cast<int>(x), count - 2), fraction = x - static_cast<float>(first);
    }
    float between(float a, float b) const { return a + fraction * (b - a); }
  };

  static float square(int i, int count) {
    const float x = static_cast<float>(i) / static_cast<float>(count - 1);
    return x * x;
  }
  static float cosine(int column) { return std::max(square(column, kColumns), kLeastCosine); }

  float& at(int row, int column) { return values_[static_cast<std::size_t>(row * kColumns + column)]; }
  float at(int row, int column) const { return values_[static_cast<std::size_t>(row * kColumns + column)]; }

  void find_means() {
    constexpr int kSteps = 400;
    for (int row = 0; row < kRows; ++row) {
      double sum = 0;
      for (int i = 0; i < kSteps; ++i) {
        const float cos = (static_cast<float>(i) + 0.5f) / kSteps;
        sum += static_cast<double>(of(cos, square(row, kRows)) * cos);
      }
      means_[static_cast<std::size_t>(row)] = static_cast<float>(2 * sum / kSteps);
    }
  }

  std::array<float, kRows * kColumns> values_;
  std::array<float, kRows> means_;
};

}  // namespace dspm
