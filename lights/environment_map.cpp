#include "dspm/lights/environment_map.h"

#include <array>
#include <cmath>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/linear_density.h"

namespace dspm {
namespace {

/// Returns the place of node i of those of `count` pixels.
double place_of_node(int i, int count) { return std::clamp((i - 0.5) / count, 0., 1.); }

/// Returns a cell's first and last node, in pixels from half a pixel before the rim.
std::pair<float, float> ends(int cell, int count) {
  const auto first = static_cast<float>(cell);
  return {std::max(first, 0.5f), std::min(first + 1, static_cast<float>(count) + 0.5f)};
}

template <class T>
T mix(const T& a, const T& b, float t) {
  return a + (b - a) * t;
}

/// Returns the pixel beyond the rim, where the picture continues: on its other side or, for the octahedron, across an
/// edge that is folded onto itself.
const Rgb& pixel_beyond(const Image& image, SphereMapping mapping, int x, int y) {
  const int w = image.width, h = image.height;
  if (mapping == SphereMapping::equirectangular) return image.at((x + w) % w, y);
  if (x < 0 || x >= w) x = x < 0 ? 0 : w - 1, y = h - 1 - y;
  if (y < 0 || y >= h) y = y < 0 ? 0 : h - 1, x = w - 1 - x;
  return image.at(x, y);
}

Rgb mean_of_row(const Image& image, int y) {
  std::array<double, 3> sum{};
  for (int x = 0; x < image.width; ++x)
    for (int c = 0; c < 3; ++c) sum[static_cast<std::size_t>(c)] += static_cast<double>(image.at(x, y)[c]);
  const auto mean = [&](std::size_t c) { return static_cast<float>(sum[c] / image.width); };
  return {mean(0), mean(1), mean(2)};
}

/// Returns the mean of the pixels on both sides of the rim. A pole, which is the whole rim of a latitude-longitude
/// picture, has one radiance.
Rgb radiance_of_node(const Image& image, SphereMapping mapping, int x, int y) {
  const bool at_pole = mapping == SphereMapping::equirectangular && (y == 0 || y == image.height + 1);
  if (at_pole) return mean_of_row(image, y == 0 ? 0 : image.height - 1);
  const bool x_at_rim = x == 0 || x == image.width + 1, y_at_rim = y == 0 || y == image.height + 1;
  Rgb sum;
  for (int down = y - 1; down <= (y_at_rim ? y : y - 1); ++down)
    for (int across = x - 1; across <= (x_at_rim ? x : x - 1); ++across)
      sum += pixel_beyond(image, mapping, across - (x == image.width + 1), down - (y == image.height + 1));
  return sum / ((x_at_rim ? 2.f : 1.f) * (y_at_rim ? 2.f : 1.f));
}

}  // namespace

/// Four nodes and what lies between them.
struct EnvironmentMap::Cell {
  struct Row {
    const Rgb &left, &right;
    float light_left = luminance(left), light_right = luminance(right);

    Rgb radiance(float across) const { return mix(left, right, across); }
    float light(float across) const { return mix(light_left, light_right, across); }
    float mean() const { return (light_left + light_right) / 2; }
  };
  Row upper, lower;
  float width;  // of places

  Rgb radiance(Vec2 rest) const { return mix(upper.radiance(rest.x), lower.radiance(rest.x), rest.y); }
  float light(Vec2 rest) const { return mix(upper.light(rest.x), lower.light(rest.x), rest.y); }
  float light_left(float down) const { return mix(upper.light_left, lower.light_left, down); }
  float light_right(float down) const { return mix(upper.light_right, lower.light_right, down); }
  /// Integrates over the cell.
  float whole(const SphereBand& band) const {
    return width * (upper.mean() * band.upper() + lower.mean() * band.lower());
  }
};

EnvironmentMap::Cell EnvironmentMap::cell(int x, int y) const {
  const auto [begin, end] = ends(x, width_);
  const float width = (end - begin) / static_cast<float>(width_);
  return {{at_node(x, y), at_node(x + 1, y)}, {at_node(x, y + 1), at_node(x + 1, y + 1)}, width};
}

EnvironmentMap::EnvironmentMap(const Image& image, SphereMapping mapping)
    : width_(image.width), height_(image.height), mapping_(mapping), rows_(std::vector<float>{0}) {
  nodes_.reserve((static_cast<std::size_t>(width_) + 2) * (static_cast<std::size_t>(height_) + 2));
  for (int y = 0; y < height_ + 2; ++y)
    for (int x = 0; x < width_ + 2; ++x) nodes_.push_back({{}, radiance_of_node(image, mapping, x, y)});
  for (int y = 0; y <= height_; ++y)
    bands_.emplace_back(mapping, place_of_node(y, height_), place_of_node(y + 1, height_));
  rows_ = distribution_of_rows();
}

/// Returns the distribution of rows, and fills the rows as well.
Distribution1D EnvironmentMap::distribution_of_rows() {
  const auto cells = static_cast<std::size_t>(width_) + 1;
  std::vector<float> totals, weights(cells);
  for (int y = 0; y <= height_; ++y) {
    for (std::size_t x = 0; x < cells; ++x)
      weights[x] = cell(static_cast<int>(x), y).whole(bands_[static_cast<std::size_t>(y)]);
    const Distribution1D columns(weights);
    Node* const first = &nodes_[static_cast<std::size_t>(y) * (cells + 1)];
    for (std::size_t x = 0; x <= cells; ++x) first[x].begin = columns.bins()[x].begin;
    add_cutpoints(row(y), cutpoints_);
    totals.push_back(columns.total());
  }
  return Distribution1D(totals);
}

bool operator==(const EnvironmentMap& a, const EnvironmentMap& b) {
  const auto same = [](const auto& one, const auto& other) { return one.radiance == other.radiance; };
  return a.mapping_ == b.mapping_ && a.width_ == b.width_ && a.height_ == b.height_ &&
         std::equal(a.nodes_.begin(), a.nodes_.end(), b.nodes_.begin(), same);
}

EnvironmentMap::Place EnvironmentMap::cell_at(const Vec3& direction) const {
  const Vec2 place = place_of(mapping_, direction);
  const auto along = [](float at, int count) {
    const float node = at * static_cast<float>(count) + 0.5f;
    const int first = std::min(static_cast<int>(node), count);
    const auto [begin, end] = ends(first, count);
    return std::pair(first, std::clamp((node - begin) / (end - begin), 0.f, 1.f));
  };
  const auto [x, across] = along(place.x, width_);
  const auto [y, down] = along(place.y, height_);
  return {x, y, {across, down}};
}

Vec3 EnvironmentMap::direction_at(const Place& at) const {
  const auto along = [](int cell, float rest, int count) {
    const auto [begin, end] = ends(cell, count);
    return (begin - 0.5f + rest * (end - begin)) / static_cast<float>(count);
  };
  return dspm::direction_at(mapping_, {along(at.x, at.rest.x, width_), along(at.y, at.rest.y, height_)});
}

Rgb EnvironmentMap::radiance(const Vec3& direction) const {
  const Place at = cell_at(direction);
  return cell(at.x, at.y).radiance(at.rest);
}

float EnvironmentMap::pdf_w(const Place& at, const Cell& cell) const {
  const float whole = cell.whole(bands_[static_cast<std::size_t>(at.y)]);
  return whole > 0 ? rows_.probability(at.y) * probability_of(row(at.y), at.x) * (cell.light(at.rest) / whole) : 0;
}

float EnvironmentMap::pdf_w(const Vec3& direction) const {
  const Place at = cell_at(direction);
  return pdf_w(at, cell(at.x, at.y));
}

// First how far down in the cell, whatever the place across; then how far across there.
EnvironmentMap::Sample EnvironmentMap::sample(Vec2 u) const {
  const BinChoice down = rows_.choose(u.y);
  const BinChoice across = choose_bin(row(down.index), cutpoints_of_row(down.index), u.x);
  const Cell here = cell(across.index, down.index);
  Place at{across.index, down.index, {}};
  at.rest.y = bands_[static_cast<std::size_t>(at.y)].sample(down.rest, here.upper.mean(), here.lower.mean());
  at.rest.x = sample_linear(across.rest, here.light_left(at.rest.y), here.light_right(at.rest.y));
  return {direction_at(at), here.radiance(at.rest), pdf_w(at, here)};
}

void EnvironmentMap::prefetch(Vec2 u) const {
  constexpr std::size_t kNodesOfLine = 64 / sizeof(Node);
  const int y = rows_.choose(u.y).index;
  const auto points = cutpoints_of_row(y);
  const Node* const first = &row(y)[points[cutpoint_of(u.x, points.size())]];
  for (const Node* node : {first, first + width_ + 2}) {
    __builtin_prefetch(node), __builtin_prefetch(node + kNodesOfLine);
  }
}

Vec2 EnvironmentMap::sample_numbers(const Vec3& direction) const {
  const Place at = cell_at(direction);
  const Cell here = cell(at.x, at.y);
  const float down = bands_[static_cast<std::size_t>(at.y)].number(at.rest.y, here.upper.mean(), here.lower.mean());
  const float across = linear_number(at.rest.x, here.light_left(at.rest.y), here.light_right(at.rest.y));
  return {bin_number(row(at.y), at.x, across), rows_.number(at.y, down)};
}

Rgb EnvironmentMap::fluence() const {
  std::array<double, 3> sum{};
  for (int y = 0; y <= height_; ++y) {
    const SphereBand& band = bands_[static_cast<std::size_t>(y)];
    for (int x = 0; x <= width_; ++x) {
      const Cell here = cell(x, y);
      const Rgb upper = here.upper.radiance(0.5f), lower = here.lower.radiance(0.5f);
      for (int c = 0; c < 3; ++c)
        sum[static_cast<std::size_t>(c)] +=
            static_cast<double>(here.width) * (static_cast<double>(upper[c]) * static_cast<double>(band.upper()) +
                                               static_cast<double>(lower[c]) * static_cast<double>(band.lower()));
    }
  }
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

float EnvironmentMap::illuminance() const {
  constexpr int kEnough = 256;  // steps across the picture
  const int steps = (kEnough - 1) / size() + 1;
  const auto middle = [&](int step) { return (static_cast<float>(step) + 0.5f) / static_cast<float>(steps); };
  double sum = 0;
  for (int y = 0; y <= height_; ++y)
    for (int down = 0; down < steps; ++down) {
      const double top = place_of_node(y, height_), bottom = place_of_node(y + 1, height_);
      const SphereBand band(mapping_, std::lerp(top, bottom, double(down) / steps),
                            std::lerp(top, bottom, double(down + 1) / steps));
      for (int x = 0; x <= width_; ++x) {
        const Cell here = cell(x, y);
        const float solid_angle = (band.upper() + band.lower()) * here.width / static_cast<float>(steps);
        for (int across = 0; across < steps; ++across) {
          const Place at{x, y, {middle(across), middle(down)}};
          const float cosine = direction_at(at).z;
          if (cosine > 0) sum += static_cast<double>(here.light(at.rest) * cosine * solid_angle);
        }
      }
    }
  return static_cast<float>(sum);
}

}  // namespace dspm
