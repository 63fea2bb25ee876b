#include "dspm/lights/environment_map.h"

#include <array>

#include "dspm/colour/rgb.h"
#include "dspm/math/vec.h"

namespace dspm {
namespace {

int cell(float place, int count) { return std::min(static_cast<int>(place * static_cast<float>(count)), count - 1); }

}  // namespace

EnvironmentMap::EnvironmentMap(const Image& image, SphereMapping mapping)
    : width_(image.width), height_(image.height), mapping_(mapping), rows_(distribution_of_rows(image)) {}

/// Fills the rows as well.
Distribution1D EnvironmentMap::distribution_of_rows(const Image& image) {
  pixels_.reserve((static_cast<std::size_t>(width_) + 1) * static_cast<std::size_t>(height_));
  std::vector<float> totals, weights(static_cast<std::size_t>(width_));
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) weights[static_cast<std::size_t>(x)] = luminance(image.at(x, y));
    const Distribution1D columns(weights);
    for (int x = 0; x < width_; ++x) pixels_.push_back({columns.bins()[static_cast<std::size_t>(x)], image.at(x, y)});
    pixels_.push_back({columns.bins().back(), Rgb()});
    add_cutpoints(row(y), cutpoints_);
    totals.push_back(columns.total() * solid_angle(y));
  }
  return Distribution1D(totals);
}

bool operator==(const EnvironmentMap& a, const EnvironmentMap& b) {
  const auto same = [](const auto& one, const auto& other) { return one.radiance == other.radiance; };
  return a.mapping_ == b.mapping_ && a.width_ == b.width_ && a.height_ == b.height_ &&
         std::equal(a.pixels_.begin(), a.pixels_.end(), b.pixels_.begin(), same);
}

float EnvironmentMap::solid_angle(int row) const {
  const float w = static_cast<float>(width_), h = static_cast<float>(height_);
  if (mapping_ == SphereMapping::equal_area) return 4 * kPi / (w * h);
  // 2 pi / w times the difference of the two edges' cosines.
  const float middle = kPi * (static_cast<float>(row) + 0.5f) / h;
  return 2 * kPi / w * 2 * std::sin(middle) * std::sin(kPi / (2 * h));
}

EnvironmentMap::Place EnvironmentMap::pixel_at(const Vec3& direction) const {
  const Vec2 place = place_of(mapping_, direction);
  const int x = cell(place.x, width_), y = cell(place.y, height_);
  const float w = static_cast<float>(width_), h = static_cast<float>(height_);
  return {x, y, {place.x * w - static_cast<float>(x), place.y * h - static_cast<float>(y)}};
}

Rgb EnvironmentMap::radiance(const Vec3& direction) const {
  const Place at = pixel_at(direction);
  return radiance(at.x, at.y);
}

float EnvironmentMap::pdf_w(int x, int y) const {
  return rows_.probability(y) * probability_of(row(y), x) / solid_angle(y);
}

float EnvironmentMap::pdf_w(const Vec3& direction) const {
  const Place at = pixel_at(direction);
  return pdf_w(at.x, at.y);
}

// Uniform by solid angle over the pixel.
Vec3 EnvironmentMap::direction_in(int x, int y, Vec2 u) const {
  const float w = static_cast<float>(width_), h = static_cast<float>(height_);
  const float column = (static_cast<float>(x) + u.x) / w, row = static_cast<float>(y);
  if (mapping_ == SphereMapping::equal_area) return direction_at(mapping_, {column, (row + u.y) / h});
  const float upper = std::cos(kPi * row / h), lower = std::cos(kPi * (row + 1) / h);
  const float z = upper + u.y * (lower - upper), s = std::sqrt(std::max(0.f, (1 - z) * (1 + z)));
  return {s * std::cos(2 * kPi * column), s * std::sin(2 * kPi * column), z};
}

EnvironmentMap::Sample EnvironmentMap::sample(Vec2 u) const {
  const auto [y, row_probability, rest_y] = rows_.choose(u.y);
  const auto [x, column_probability, rest_x] = choose_bin(row(y), cutpoints_of_row(y), u.x);
  return {direction_in(x, y, {rest_x, rest_y}), radiance(x, y), row_probability * column_probability / solid_angle(y)};
}

void EnvironmentMap::prefetch(Vec2 u) const {
  constexpr std::size_t kPixelsOfLine = 64 / sizeof(Pixel);
  const int y = rows_.choose(u.y).index;
  const auto points = cutpoints_of_row(y);
  const Pixel* const first = &row(y)[points[cutpoint_of(u.x, points.size())]];
  __builtin_prefetch(first), __builtin_prefetch(first + kPixelsOfLine);
}

Vec2 EnvironmentMap::sample_numbers(const Vec3& direction) const {
  auto [x, y, rest] = pixel_at(direction);
  if (mapping_ == SphereMapping::equirectangular) {
    const float h = static_cast<float>(height_), row = static_cast<float>(y);
    const float upper = std::cos(kPi * row / h), lower = std::cos(kPi * (row + 1) / h);
    rest.y = std::clamp((direction.z - upper) / (lower - upper), 0.f, 1.f);
  }
  return {bin_number(row(y), x, rest.x), rows_.number(y, rest.y)};
}

Rgb EnvironmentMap::fluence() const {
  std::array<double, 3> sum{};
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      for (int c = 0; c < 3; ++c)
        sum[static_cast<std::size_t>(c)] +=
            static_cast<double>(radiance(x, y)[c]) * static_cast<double>(solid_angle(y));
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

float EnvironmentMap::illuminance() const {
  double sum = 0;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const float cosine = direction_in(x, y, {0.5f, 0.5f}).z;
      if (cosine > 0) sum += static_cast<double>(luminance(radiance(x, y)) * cosine * solid_angle(y));
    }
  return static_cast<float>(sum);
}

}  // namespace dspm
