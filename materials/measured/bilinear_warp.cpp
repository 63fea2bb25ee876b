#include "dspm/materials/measured/bilinear_warp.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

struct Between {
  std::size_t first, second;
  float t;
};
Between between(const std::vector<float>& values, float v) {
  const auto after = static_cast<std::size_t>(std::upper_bound(values.begin(), values.end(), v) - values.begin());
  if (after == 0 || after == values.size()) {
    const std::size_t end = after == 0 ? 0 : after - 1;
    return {end, end, 0};
  }
  return {after - 1, after, (v - values[after - 1]) / (values[after] - values[after - 1])};
}

/// Returns the share t of a cell below which lies `part` of the integral of a density that runs linearly from a to b.
float solve_linear(float part, float a, float b) {
  const float root = std::sqrt(std::max(0.f, a * a + 2 * part * (b - a)));
  return a + root > 0 ? std::clamp(2 * part / (a + root), 0.f, 1.f) : 0;
}
float integral_of_linear(float t, float a, float b) { return t * (a + 0.5f * t * (b - a)); }

/// Returns the last i below `last` with until(i) <= part.
template <class Until>
int find_cell(int last, float part, Until&& until) {
  int low = 0, high = last;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (until(middle) <= part ? low : high) = middle;
  }
  return low;
}

float mix(float a, float b, float t) { return a * (1 - t) + b * t; }

}  // namespace

GridMix GridParameters::at(float first, float second) const {
  const Between a = between(first_, first), b = between(second_, second);
  const std::size_t row = second_.size();
  return {{a.first * row + b.first, a.first * row + b.second, a.second * row + b.first, a.second * row + b.second},
          {(1 - a.t) * (1 - b.t), (1 - a.t) * b.t, a.t * (1 - b.t), a.t * b.t}};
}

GridPlace::GridPlace(const Vec2& p, int width, int height) {
  const float px = std::clamp(p.x, 0.f, 1.f) * static_cast<float>(width - 1),
              py = std::clamp(p.y, 0.f, 1.f) * static_cast<float>(height - 1);
  x = std::min(static_cast<int>(px), width - 2), y = std::min(static_cast<int>(py), height - 2);
  tx = px - static_cast<float>(x), ty = py - static_cast<float>(y);
}

BilinearWarp::BilinearWarp(std::span<const float> values, int width, int height)
    : width_(width), height_(height), values_(values.begin(), values.end()) {
  const double dx = 1.0 / (width - 1), dy = 1.0 / (height - 1);
  rows_.resize(values_.size());
  below_.resize(values_.size() / static_cast<std::size_t>(width));
  for (std::size_t grid = 0; grid < values_.size() / cells(); ++grid) {
    float* of = values_.data() + grid * cells();
    float* rows = rows_.data() + grid * cells();
    float* below = below_.data() + grid * static_cast<std::size_t>(height);
    std::vector<double> sums(cells()), sum_below(static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
      for (int x = 1; x < width; ++x)
        sums[index(x, y)] = sums[index(x - 1, y)] + 0.5 * dx * (double{of[index(x - 1, y)]} + double{of[index(x, y)]});
      if (y == 0) continue;
      const auto row = static_cast<std::size_t>(y);
      sum_below[row] = sum_below[row - 1] + 0.5 * dy * (sums[index(width - 1, y - 1)] + sums[index(width - 1, y)]);
    }
    const double all = sum_below.back();
    for (std::size_t i = 0; i < cells(); ++i)
      rows[i] = static_cast<float>(sums[i] / all), of[i] = static_cast<float>(double{of[i]} / all);
    for (std::size_t y = 0; y < sum_below.size(); ++y) below[y] = static_cast<float>(sum_below[y] / all);
  }
}

BilinearWarp::Point BilinearWarp::sample(const Vec2& u, const GridMix& m) const {
  const auto columns = static_cast<float>(width_ - 1), rows = static_cast<float>(height_ - 1);
  const float part = u.y * below(height_ - 1, m);
  const int y = find_cell(height_ - 1, part, [&](int i) { return below(i, m); });
  const float row0 = row(y, m), row1 = row(y + 1, m);
  const float ty = solve_linear((part - below(y, m)) * rows, row0, row1);
  const auto until = [&](int i) { return mix(row_until(i, y, m), row_until(i, y + 1, m), ty); };
  const float along = u.x * until(width_ - 1);
  const int x = find_cell(width_ - 1, along, until);
  const float v0 = mix(value(x, y, m), value(x, y + 1, m), ty),
              v1 = mix(value(x + 1, y, m), value(x + 1, y + 1, m), ty);
  const float tx = solve_linear((along - until(x)) * columns, v0, v1);
  return {{(static_cast<float>(x) + tx) / columns, (static_cast<float>(y) + ty) / rows}, mix(v0, v1, tx)};
}

BilinearWarp::Point BilinearWarp::invert(const Vec2& p, const GridMix& m) const {
  const auto columns = static_cast<float>(width_ - 1), rows = static_cast<float>(height_ - 1);
  const GridPlace at(p, width_, height_);
  const float row0 = row(at.y, m), row1 = row(at.y + 1, m);
  const auto until = [&](int i) { return mix(row_until(i, at.y, m), row_until(i, at.y + 1, m), at.ty); };
  const float v0 = mix(value(at.x, at.y, m), value(at.x, at.y + 1, m), at.ty),
              v1 = mix(value(at.x + 1, at.y, m), value(at.x + 1, at.y + 1, m), at.ty);
  const float whole = until(width_ - 1);
  const float along = until(at.x) + integral_of_linear(at.tx, v0, v1) / columns;
  const float u = whole > 0 ? along / whole : 0;
  const float v = (below(at.y, m) + integral_of_linear(at.ty, row0, row1) / rows) / below(height_ - 1, m);
  return {{std::clamp(u, 0.f, 1.f), std::clamp(v, 0.f, 1.f)}, mix(v0, v1, at.tx)};
}

float BilinearWarp::density(const Vec2& p, const GridMix& m) const {
  return GridPlace(p, width_, height_).interpolate([&](int x, int y) { return value(x, y, m); });
}

}  // namespace dspm
