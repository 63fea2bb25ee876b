#include "dspm/lights/window_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/math/rounded.h"
#include "dspm/lights/solid_angle.h"

namespace dspm {
namespace {

/// The edge of a cell in the plane z = 1.
double edge(int cell, int side) {
  constexpr double kFarAway = 1e8;
  if (cell == 0 || cell == side) return cell == 0 ? -kFarAway : kFarAway;
  return std::tan((static_cast<double>(cell) / side - 0.5) * M_PI);
}

double solid_angle(int x, int y, int side) {
  return between_corners(edge(x, side), edge(y, side), edge(x + 1, side), edge(y + 1, side), solid_angle_to);
}
double projected_solid_angle(int x, int y, int side) {
  return between_corners(edge(x, side), edge(y, side), edge(x + 1, side), edge(y + 1, side), projected_solid_angle_to);
}

/// Returns the t in [low, high] with f(t) = value, for an f that is monotone, and linear between whole numbers.
template <class F>
double inverse(double low, double high, double value, F&& f) {
  int first = static_cast<int>(low), last = static_cast<int>(std::ceil(high));
  while (last - first > 1) {
    const int middle = (first + last) / 2;
    (f(middle) <= value ? first : last) = middle;
  }
  const double a = std::max(low, double(first)), b = std::min(high, double(last)), fa = f(a), fb = f(b);
  return fb > fa ? std::clamp(a + (value - fa) / (fb - fa) * (b - a), a, b) : a;
}

}  // namespace

Vec3 WindowMap::direction_at(Vec2 place) {
  const float x = rounded::tan((place.x - 0.5f) * kPi), y = rounded::tan((place.y - 0.5f) * kPi);
  return normalize({x, y, 1});
}

Vec2 WindowMap::place_of(const Vec3& direction) {
  return {rounded::atan2(direction.x, direction.z) / kPi + 0.5f, rounded::atan2(direction.y, direction.z) / kPi + 0.5f};
}

// The angles' tangents are x / z and y / z, and an area of the plane z = 1 is seen at z^3 times its size.
float WindowMap::solid_angle_per_place(const Vec3& d) {
  return kPi * kPi * (1 - d.x * d.x) * (1 - d.y * d.y) / std::max(d.z, 1e-6f);
}

int WindowMap::cell(float place) const { return std::clamp(static_cast<int>(place * side()), 0, image_.width - 1); }

/// Returns the luminance by which a cell is sampled. Light that reaches into a cell between the directions that were
/// looked up is sampled, too: its neighbours have it.
float WindowMap::sampled_light(int x, int y) const {
  constexpr float kShare = 1 / 8.f;
  float around = 0;
  const auto within = [&](int i) { return std::clamp(i, 0, image_.width - 1); };
  for (int down = y - 1; down <= y + 1; ++down)
    for (int across = x - 1; across <= x + 1; ++across) around += luminance(image_.at(within(across), within(down)));
  return std::max(luminance(image_.at(x, y)), kShare / 9 * around);
}

void WindowMap::sum() {
  const int n = image_.width;
  const auto at = [&](int x, int y) -> double& { return sums_[static_cast<std::size_t>(y * (n + 1) + x)]; };
  sums_.assign(static_cast<std::size_t>((n + 1) * (n + 1)), 0);
  std::vector<float> crossing(static_cast<std::size_t>(n)), of_rows;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const float light = sampled_light(x, y);
      at(x + 1, y + 1) = at(x, y + 1) + at(x + 1, y) - at(x, y) + static_cast<double>(light) * solid_angle(x, y, n);
      crossing[static_cast<std::size_t>(x)] = light * static_cast<float>(projected_solid_angle(x, y, n));
    }
    of_rows.push_back(columns_.emplace_back(crossing).total());
  }
  rows_ = Distribution1D(of_rows);
}

double WindowMap::sum_to(double x, double y) const {
  const int n = image_.width, column = std::min(static_cast<int>(x), n - 1), row = std::min(static_cast<int>(y), n - 1);
  const double dx = x - column, dy = y - row;
  const double* at = sums_.data() + static_cast<std::size_t>(row * (n + 1) + column);
  return std::lerp(std::lerp(at[0], at[1], dx), std::lerp(at[n + 1], at[n + 2], dx), dy);
}

double WindowMap::sum_in(double x0, double y0, double x1, double y1) const {
  return std::max(0., sum_to(x1, y1) - sum_to(x0, y1) - sum_to(x1, y0) + sum_to(x0, y0));
}

// Uniform within the cell, by place.
float WindowMap::density(int x, int y, double whole, const Vec3& direction) const {
  return static_cast<float>(weight(x, y) / whole) * side() * side() / solid_angle_per_place(direction);
}

std::optional<WindowMap::Sample> WindowMap::sample(const Part& part, Vec2 u) const {
  const auto cells = [&](float place) {
    return std::clamp(static_cast<double>(place * side()), 0., 1. * image_.width);
  };
  const double x0 = cells(part.low.x), y0 = cells(part.low.y), x1 = cells(part.high.x), y1 = cells(part.high.y);
  const double whole = sum_in(x0, y0, x1, y1);
  if (!(whole > 0)) return std::nullopt;
  const double x = inverse(x0, x1, static_cast<double>(u.x) * whole, [&](double t) { return sum_in(x0, y0, t, y1); });
  const int column = std::min(static_cast<int>(x), image_.width - 1);
  const double of_column = sum_in(column, y0, column + 1, y1);
  const double y = inverse(y0, y1, static_cast<double>(u.y) * of_column,
                           [&](double t) { return sum_in(column, y0, column + 1, t); });
  const int row = std::min(static_cast<int>(y), image_.width - 1);
  const Vec3 direction = direction_at({static_cast<float>(x) / side(), static_cast<float>(y) / side()});
  const float pdf_w = density(column, row, whole, direction);
  if (!(pdf_w > 0)) return std::nullopt;
  return Sample{direction, pdf_w};
}

float WindowMap::pdf_w(const Part& part, Vec2 place) const {
  const auto cells = [&](float p) { return std::clamp(static_cast<double>(p * side()), 0., 1. * image_.width); };
  const double whole = sum_in(cells(part.low.x), cells(part.low.y), cells(part.high.x), cells(part.high.y));
  return whole > 0 ? density(cell(place.x), cell(place.y), whole, direction_at(place)) : 0;
}

WindowMap::Sample WindowMap::sample_crossing(Vec2 u) const {
  const auto [y, row_probability, rest_y] = rows_.choose(u.y);
  const auto [x, column_probability, rest_x] = columns_[static_cast<std::size_t>(y)].choose(u.x);
  const Vec3 direction =
      direction_at({(static_cast<float>(x) + rest_x) / side(), (static_cast<float>(y) + rest_y) / side()});
  const float of_cell = row_probability * column_probability * side() * side();
  return {direction, of_cell / solid_angle_per_place(direction)};
}

float WindowMap::crossing_pdf_w(Vec2 place) const {
  const int x = cell(place.x), y = cell(place.y);
  const float of_cell = rows_.probability(y) * columns_[static_cast<std::size_t>(y)].probability(x) * side() * side();
  return of_cell / solid_angle_per_place(direction_at(place));
}

Vec2 WindowMap::crossing_numbers(Vec2 place) const {
  const int x = cell(place.x), y = cell(place.y);
  return {
      columns_[static_cast<std::size_t>(y)].number(x, std::clamp(place.x * side() - static_cast<float>(x), 0.f, 1.f)),
      rows_.number(y, std::clamp(place.y * side() - static_cast<float>(y), 0.f, 1.f))};
}

Rgb WindowMap::irradiance() const {
  std::array<double, 3> sum{};
  for (int y = 0; y < image_.height; ++y)
    for (int x = 0; x < image_.width; ++x)
      for (int c = 0; c < 3; ++c)
        sum[static_cast<std::size_t>(c)] +=
            static_cast<double>(image_.at(x, y)[c]) * projected_solid_angle(x, y, image_.width);
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

}  // namespace dspm
