#include "dspm/lights/environment_map.h"

#include <array>

#include "dspm/colour/rgb.h"
#include "dspm/math/vec.h"

namespace dspm {
namespace {

int cell(float place, int count) { return std::min(static_cast<int>(place * static_cast<float>(count)), count - 1); }

}  // namespace

EnvironmentMap::EnvironmentMap(Image image, SphereMapping mapping)
    : image_(std::move(image)),
      mapping_(mapping),
      columns_(distributions_within_rows()),
      rows_(distribution_of_rows()) {}

std::vector<Distribution1D> EnvironmentMap::distributions_within_rows() const {
  std::vector<Distribution1D> columns;
  columns.reserve(static_cast<std::size_t>(image_.height));
  std::vector<float> weights(static_cast<std::size_t>(image_.width));
  for (int y = 0; y < image_.height; ++y) {
    for (int x = 0; x < image_.width; ++x) weights[static_cast<std::size_t>(x)] = luminance(image_.at(x, y));
    columns.emplace_back(weights);
  }
  return columns;
}

Distribution1D EnvironmentMap::distribution_of_rows() const {
  std::vector<float> weights;
  weights.reserve(columns_.size());
  for (int y = 0; y < image_.height; ++y)
    weights.push_back(columns_[static_cast<std::size_t>(y)].total() * solid_angle(y));
  return Distribution1D(weights);
}

float EnvironmentMap::solid_angle(int row) const {
  const float w = static_cast<float>(image_.width), h = static_cast<float>(image_.height);
  if (mapping_ == SphereMapping::equal_area) return 4 * kPi / (w * h);
  // 2 pi / w times the difference of the two edges' cosines.
  const float middle = kPi * (static_cast<float>(row) + 0.5f) / h;
  return 2 * kPi / w * 2 * std::sin(middle) * std::sin(kPi / (2 * h));
}

std::size_t EnvironmentMap::pixel_at(const Vec3& direction) const {
  const Vec2 place = place_of(mapping_, direction);
  return image_.index(cell(place.x, image_.width), cell(place.y, image_.height));
}

float EnvironmentMap::pdf_w(int x, int y) const {
  return rows_.probability(y) * columns_[static_cast<std::size_t>(y)].probability(x) / solid_angle(y);
}

float EnvironmentMap::pdf_w(const Vec3& direction) const {
  const Vec2 place = place_of(mapping_, direction);
  return pdf_w(cell(place.x, image_.width), cell(place.y, image_.height));
}

// Uniform by solid angle over the pixel.
Vec3 EnvironmentMap::direction_in(int x, int y, Vec2 u) const {
  const float w = static_cast<float>(image_.width), h = static_cast<float>(image_.height);
  const float column = (static_cast<float>(x) + u.x) / w, row = static_cast<float>(y);
  if (mapping_ == SphereMapping::equal_area) return direction_at(mapping_, {column, (row + u.y) / h});
  const float upper = std::cos(kPi * row / h), lower = std::cos(kPi * (row + 1) / h);
  const float z = upper + u.y * (lower - upper), s = std::sqrt(std::max(0.f, (1 - z) * (1 + z)));
  return {s * std::cos(2 * kPi * column), s * std::sin(2 * kPi * column), z};
}

EnvironmentMap::Sample EnvironmentMap::sample(Vec2 u) const {
  const auto [y, row_probability, rest_y] = rows_.choose(u.y);
  const auto [x, column_probability, rest_x] = columns_[static_cast<std::size_t>(y)].choose(u.x);
  return {direction_in(x, y, {rest_x, rest_y}), image_.at(x, y), row_probability * column_probability / solid_angle(y)};
}

Vec2 EnvironmentMap::sample_numbers(const Vec3& direction) const {
  const Vec2 place = place_of(mapping_, direction);
  const int x = cell(place.x, image_.width), y = cell(place.y, image_.height);
  const float h = static_cast<float>(image_.height), row = static_cast<float>(y);
  Vec2 rest{place.x * static_cast<float>(image_.width) - static_cast<float>(x), place.y * h - row};
  if (mapping_ == SphereMapping::equirectangular) {
    const float upper = std::cos(kPi * row / h), lower = std::cos(kPi * (row + 1) / h);
    rest.y = std::clamp((direction.z - upper) / (lower - upper), 0.f, 1.f);
  }
  return {columns_[static_cast<std::size_t>(y)].number(x, rest.x), rows_.number(y, rest.y)};
}

Rgb EnvironmentMap::fluence() const {
  std::array<double, 3> sum{};
  for (int y = 0; y < image_.height; ++y)
    for (int x = 0; x < image_.width; ++x)
      for (int c = 0; c < 3; ++c)
        sum[static_cast<std::size_t>(c)] +=
            static_cast<double>(image_.at(x, y)[c]) * static_cast<double>(solid_angle(y));
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

float EnvironmentMap::illuminance() const {
  double sum = 0;
  for (int y = 0; y < image_.height; ++y)
    for (int x = 0; x < image_.width; ++x) {
      const float cosine = direction_in(x, y, {0.5f, 0.5f}).z;
      if (cosine > 0) sum += static_cast<double>(luminance(image_.at(x, y)) * cosine * solid_angle(y));
    }
  return static_cast<float>(sum);
}

}  // namespace dspm
