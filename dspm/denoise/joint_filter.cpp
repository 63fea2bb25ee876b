#include "dspm/denoise/joint_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/denoise/tile.h"
#include "dspm/system/parallel.h"

namespace dspm {
namespace {

float number(float value) { return std::isfinite(value) ? value : 0; }

/// Calls fn(index of the pixel, x, y) on many threads.
template <class Fn>
void for_each_pixel(const Image& image, const Fn& fn) {
  constexpr int kRows = 8;
  parallel_for(image.height, kRows, [&](std::int64_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < image.width; ++x) fn(image.index(x, y), x, y);
  });
}

/// Calls fn(index) for the pixels of a square around one, as far as they exist.
template <class Fn>
void around(const Image& image, int x, int y, int radius, const Fn& fn) {
  for (int v = std::max(y - radius, 0); v <= std::min(y + radius, image.height - 1); ++v)
    for (int u = std::max(x - radius, 0); u <= std::min(x + radius, image.width - 1); ++u) fn(image.index(u, v));
}

/// What radiance is divided by, so that textures do not part pixels under the same light: the albedo, from which the
/// noise of glossy ones is smoothed; 1 for what is nearly black, such as lamps.
Image divisors(const Image& albedo) {
  constexpr int kRadius = 2;
  constexpr float kNoise = 0.06f, kBlack = 0.02f;
  Image divisors(albedo.width, albedo.height);
  for_each_pixel(albedo, [&](std::size_t pixel, int x, int y) {
    const Rgb centre = albedo.pixels[pixel];
    Rgb sum;
    float weights = 0;
    around(albedo, x, y, kRadius, [&](std::size_t other) {
      const Rgb d = (albedo.pixels[other] - centre) * (1 / kNoise);
      const float weight = std::max(0.f, 1 - (d.r * d.r + d.g * d.g + d.b * d.b) / 8);
      if (weight > 0) sum += albedo.pixels[other] * (weight * weight), weights += weight * weight;
    });
    for (int c = 0; c < 3; ++c) {
      const float mean = number(sum[c] / weights);
      divisors.pixels[pixel][c] = mean > kBlack ? std::min(mean, 1.f) : 1;
    }
  });
  return divisors;
}

/// The geometric mean around a pixel: few iterations know little of their variance, and one firefly should not make its
/// neighbours seem as uncertain as itself.
std::vector<float> smoothed_variance(const Image& size, const std::vector<float>& variance) {
  std::vector<float> roots(variance.size()), smoothed(variance.size());
  for (std::size_t i = 0; i < variance.size(); ++i) roots[i] = std::sqrt(std::sqrt(variance[i]));
  for_each_pixel(size, [&](std::size_t pixel, int x, int y) {
    float sum = 0;
    int count = 0;
    around(size, x, y, 1, [&](std::size_t other) { sum += roots[other], ++count; });
    const float mean = sum / static_cast<float>(count);
    smoothed[pixel] = mean * mean * mean * mean;
  });
  return smoothed;
}

Planes planes_of(const NoisyImage& image, const Image& divisors) {
  const Image& radiance = image.radiance;
  Planes planes{radiance.width, radiance.height, {}};
  for (std::vector<float>& plane : planes.values) plane.resize(radiance.pixels.size());
  for_each_pixel(radiance, [&](std::size_t i, int, int) {
    float variance = 0;
    for (int c = 0; c < 3; ++c) {
      const float divisor = divisors.pixels[i][c], of_component = image.variance.pixels[i][c] / (divisor * divisor);
      planes.values[static_cast<std::size_t>(c)][i] = radiance.pixels[i][c] / divisor;
      planes.values[static_cast<std::size_t>(kNormalX + c)][i] = number(image.normal.pixels[i][c]);
      variance += std::max(0.f, number(of_component));
    }
    const float depth = image.depth.pixels[i].r;
    planes.values[kVariance][i] = variance;
    planes.values[kNearness][i] = depth < kNoSurface ? number(1 / depth) : 0;
  });
  planes.values[kVariance] = smoothed_variance(radiance, planes.values[kVariance]);
  const std::vector<float>& nearness = planes.values[kNearness];
  for_each_pixel(radiance, [&](std::size_t i, int x, int y) {
    const auto change = [&](int u, int v) {
      const bool exists = u >= 0 && v >= 0 && u < radiance.width && v < radiance.height;
      return exists ? std::abs(nearness[radiance.index(u, v)] - nearness[i]) : 0;
    };
    planes.values[kSlope][i] =
        std::max(std::min(change(x - 1, y), change(x + 1, y)), std::min(change(x, y - 1), change(x, y + 1)));
  });
  return planes;
}

/// The nearest pixels and, farther away, every second of every second row: photons blur their noise over more than that,
/// so those between would add little.
std::vector<Offset> offsets() {
  std::vector<Offset> all;
  for (int y = -Tile::kReach; y <= Tile::kReach; ++y)
    for (int x = -Tile::kReach; x <= Tile::kReach; ++x) {
      const bool is_next = std::abs(x) <= 1 && std::abs(y) <= 1, is_on_grid = x % 2 == 0 && y % 2 == 0;
      if (is_next || (is_on_grid && x * x + y * y <= Tile::kReach * Tile::kReach)) all.push_back({x, y});
    }
  return all;
}

}  // namespace

Image joint_filtered(const NoisyImage& image) {
  Image result = image.radiance;
  const Image divisors = dspm::divisors(image.albedo);
  const Planes planes = planes_of(image, divisors);
  const std::vector<Offset> offsets = dspm::offsets();
  const int across = (result.width + Tile::kSide - 1) / Tile::kSide,
            down = (result.height + Tile::kSide - 1) / Tile::kSide;
  parallel_for(across * down, 1, [&](std::int64_t number) {
    const int x = static_cast<int>(number) % across * Tile::kSide, y = static_cast<int>(number) / across * Tile::kSide;
    Tile tile(planes, x, y);
    for (const Offset offset : offsets) tile.add(offset);
    for (int row = 0; row < std::min(Tile::kSide, result.height - y); ++row)
      for (int column = 0; column < std::min(Tile::kSide, result.width - x); ++column) {
        const std::size_t i = result.index(x + column, y + row);
        const Rgb mean(tile.mean(kRed, row, column), tile.mean(kGreen, row, column), tile.mean(kBlue, row, column));
        if (tile.is_mixed(row, column) && is_finite(mean)) result.pixels[i] = mean * divisors.pixels[i];
      }
  });
  return result;
}

}  // namespace dspm
