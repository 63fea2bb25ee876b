#include "dspm/lights/screen_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dspm/lights/solid_angle.h"

namespace dspm {
namespace {

constexpr int kFewestCells = 64;  // along the shorter axis

Vec2 half_of_screen(const Image& image, float fov) {
  const float tangent = std::tan(fov / 360 * kPi);
  const float aspect = static_cast<float>(image.width) / static_cast<float>(image.height);
  return {tangent * std::max(aspect, 1.f), tangent * std::max(1 / aspect, 1.f)};
}

}  // namespace

ScreenImage::ScreenImage(Image image, float fov)
    : image_(std::move(image)),
      half_(half_of_screen(image_, fov)),
      cut_((kFewestCells - 1) / std::min(image_.width, image_.height) + 1),
      width_(image_.width * cut_),
      height_(image_.height * cut_),
      columns_(distributions_within_rows()),
      rows_(distribution_of_rows()) {}

float ScreenImage::solid_angle(int x, int y) const {
  const auto edge = [](int cell, int cells, float half) { return static_cast<double>(half) * (2. * cell / cells - 1); };
  const double left = edge(x, width_, half_.x), right = edge(x + 1, width_, half_.x);
  const double top = edge(y, height_, half_.y), bottom = edge(y + 1, height_, half_.y);
  return static_cast<float>(between_corners(left, top, right, bottom, solid_angle_to));
}

std::vector<Distribution1D> ScreenImage::distributions_within_rows() const {
  std::vector<Distribution1D> columns;
  columns.reserve(static_cast<std::size_t>(height_));
  std::vector<float> weights(static_cast<std::size_t>(width_));
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) weights[static_cast<std::size_t>(x)] = luminance(pixel(x, y)) * solid_angle(x, y);
    columns.emplace_back(weights);
  }
  return columns;
}

Distribution1D ScreenImage::distribution_of_rows() const {
  std::vector<float> weights;
  weights.reserve(columns_.size());
  for (const Distribution1D& row : columns_) weights.push_back(row.total());
  return Distribution1D(weights);
}

std::optional<ScreenImage::Place> ScreenImage::place_of(const Vec3& direction) const {
  if (!(direction.z > 0)) return std::nullopt;
  const float x = 0.5f * (1 + direction.x / direction.z / half_.x),
              y = 0.5f * (1 - direction.y / direction.z / half_.y);
  if (!(x >= 0 && x <= 1 && y >= 0 && y <= 1)) return std::nullopt;
  const float across = x * static_cast<float>(width_), down = y * static_cast<float>(height_);
  const int column = std::min(static_cast<int>(across), width_ - 1),
            row = std::min(static_cast<int>(down), height_ - 1);
  return Place{column, row, {across - static_cast<float>(column), down - static_cast<float>(row)}};
}

// Uniform within the cell, whose area an angle covers by 1 / cos^3.
float ScreenImage::pdf_w(int x, int y, float cosine) const {
  const float area = 4 * half_.x * half_.y / (static_cast<float>(width_) * static_cast<float>(height_));
  const float probability = rows_.probability(y) * columns_[static_cast<std::size_t>(y)].probability(x);
  return probability / (area * cosine * cosine * cosine);
}

Rgb ScreenImage::radiance(const Vec3& direction) const {
  const auto place = place_of(direction);
  return place ? pixel(place->x, place->y) : Rgb();
}

float ScreenImage::pdf_w(const Vec3& direction) const {
  const auto place = place_of(direction);
  return place ? pdf_w(place->x, place->y, direction.z) : 0;
}

ScreenImage::Sample ScreenImage::sample(Vec2 u) const {
  const auto [y, row_probability, rest_y] = rows_.choose(u.y);
  const auto [x, column_probability, rest_x] = columns_[static_cast<std::size_t>(y)].choose(u.x);
  const float across = (static_cast<float>(x) + rest_x) / static_cast<float>(width_);
  const float down = (static_cast<float>(y) + rest_y) / static_cast<float>(height_);
  const Vec3 direction = normalize({half_.x * (2 * across - 1), half_.y * (1 - 2 * down), 1});
  return {direction, pixel(x, y), pdf_w(x, y, direction.z)};
}

Vec2 ScreenImage::sample_numbers(const Vec3& direction) const {
  const auto place = place_of(direction);
  if (!place) return {};
  return {columns_[static_cast<std::size_t>(place->y)].number(place->x, place->rest.x),
          rows_.number(place->y, place->rest.y)};
}

Rgb ScreenImage::fluence() const {
  std::array<double, 3> sum{};
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      for (int c = 0; c < 3; ++c)
        sum[static_cast<std::size_t>(c)] +=
            static_cast<double>(pixel(x, y)[c]) * static_cast<double>(solid_angle(x, y));
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

}  // namespace dspm
