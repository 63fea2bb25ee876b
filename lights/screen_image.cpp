#include "dspm/lights/screen_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dspm/base/math/rounded.h"
#include "dspm/lights/linear_density.h"
#include "dspm/lights/solid_angle.h"

namespace dspm {
namespace {

/// Returns an even number of cells for each pixel, and not few along the shorter axis.
int cells_of_pixel(const Image& image) {
  constexpr int kFewest = 64;
  return 2 * ((kFewest - 1) / (2 * std::min(image.width, image.height)) + 1);
}

Vec2 half_of_screen(const Image& image, float fov) {
  const float tangent = rounded::tan(fov / 360 * kPi);
  const float aspect = static_cast<float>(image.width) / static_cast<float>(image.height);
  return {tangent * std::max(aspect, 1.f), tangent * std::max(1 / aspect, 1.f)};
}

}  // namespace

/// The luminance of a cell: of its corners and what lies between them.
struct ScreenImage::Cell {
  float upper_left, upper_right, lower_left, lower_right;

  float upper() const { return (upper_left + upper_right) / 2; }
  float lower() const { return (lower_left + lower_right) / 2; }
  float mean() const { return (upper() + lower()) / 2; }
  float left(float down) const { return upper_left + (lower_left - upper_left) * down; }
  float right(float down) const { return upper_right + (lower_right - upper_right) * down; }
  float at(Vec2 rest) const { return left(rest.y) + (right(rest.y) - left(rest.y)) * rest.x; }
};

ScreenImage::ScreenImage(Image image, float fov)
    : half_(half_of_screen(image, fov)),
      width_(image.width * cells_of_pixel(image)),
      height_(image.height * cells_of_pixel(image)),
      picture_(std::move(image)),
      columns_(distributions_within_rows()),
      rows_(distribution_of_rows()) {}

ScreenImage::Cell ScreenImage::cell(int x, int y) const {
  const auto corner = [&](float right, float down) { return luminance(at(place_in(x, y, {right, down}))); };
  return {corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)};
}

Vec2 ScreenImage::place_in(int x, int y, Vec2 rest) const {
  return {(static_cast<float>(x) + rest.x) / static_cast<float>(width_),
          (static_cast<float>(y) + rest.y) / static_cast<float>(height_)};
}

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
    for (int x = 0; x < width_; ++x) weights[static_cast<std::size_t>(x)] = cell(x, y).mean() * solid_angle(x, y);
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

// By luminance within the cell, whose area an angle covers by 1 / cos^3.
float ScreenImage::pdf_w(const Place& place, const Cell& cell, float cosine) const {
  if (!(cell.mean() > 0)) return 0;
  const float area = 4 * half_.x * half_.y / (static_cast<float>(width_) * static_cast<float>(height_));
  const float probability =
      rows_.probability(place.y) * columns_[static_cast<std::size_t>(place.y)].probability(place.x);
  return probability * (cell.at(place.rest) / cell.mean()) / (area * cosine * cosine * cosine);
}

Rgb ScreenImage::radiance(const Vec3& direction) const {
  const auto place = place_of(direction);
  return place ? at(place_in(place->x, place->y, place->rest)) : Rgb();
}

float ScreenImage::pdf_w(const Vec3& direction) const {
  const auto place = place_of(direction);
  return place ? pdf_w(*place, cell(place->x, place->y), direction.z) : 0;
}

ScreenImage::Sample ScreenImage::sample(Vec2 u) const {
  const BinChoice down = rows_.choose(u.y), across = columns_[static_cast<std::size_t>(down.index)].choose(u.x);
  const Cell here = cell(across.index, down.index);
  Place place{across.index, down.index, {}};
  place.rest.y = sample_linear(down.rest, here.upper(), here.lower());
  place.rest.x = sample_linear(across.rest, here.left(place.rest.y), here.right(place.rest.y));
  const Vec2 at_screen = place_in(place.x, place.y, place.rest);
  const Vec3 direction = normalize({half_.x * (2 * at_screen.x - 1), half_.y * (1 - 2 * at_screen.y), 1});
  return {direction, at(at_screen), pdf_w(place, here, direction.z)};
}

Vec2 ScreenImage::sample_numbers(const Vec3& direction) const {
  const auto place = place_of(direction);
  if (!place) return {};
  const Cell here = cell(place->x, place->y);
  const float across = linear_number(place->rest.x, here.left(place->rest.y), here.right(place->rest.y));
  return {columns_[static_cast<std::size_t>(place->y)].number(place->x, across),
          rows_.number(place->y, linear_number(place->rest.y, here.upper(), here.lower()))};
}

Rgb ScreenImage::fluence() const {
  std::array<double, 3> sum{};
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const Rgb mean = at(place_in(x, y, {0.5f, 0.5f}));
      for (int c = 0; c < 3; ++c)
        sum[static_cast<std::size_t>(c)] += static_cast<double>(mean[c]) * static_cast<double>(solid_angle(x, y));
    }
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

}  // namespace dspm
