#include "dspm/image/denoise/joint_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/parallel.h"
#include "dspm/image/denoise/around.h"
#include "dspm/image/denoise/specks.h"
#include "dspm/image/denoise/tile.h"

namespace dspm {
namespace {

float number(float value) { return std::isfinite(value) ? value : 0; }

/// Returns what radiance is divided by, so that textures do not part pixels under the same light: the albedo, from
/// which the noise of glossy ones is smoothed. It is at least kBlack: what is darker shows light that its albedo does
/// not know.
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
      divisors.pixels[pixel][c] = std::clamp(mean, kBlack, 1.f);
    }
  });
  return divisors;
}

/// Returns the variance of radiance over the divisors, as the geometric mean around a pixel: few iterations know little
/// of their variance, and one firefly should not make its neighbours seem as uncertain as itself.
Image smoothed_variance(const Image& variance, const Image& divisors) {
  Image roots(variance.width, variance.height), smoothed = roots;
  for_each_pixel(variance, [&](std::size_t i, int, int) {
    for (int c = 0; c < 3; ++c) {
      const float divisor = divisors.pixels[i][c];
      const float known = std::max(0.f, number(variance.pixels[i][c] / (divisor * divisor)));
      roots.pixels[i][c] = std::sqrt(std::sqrt(known));
    }
  });
  for_each_pixel(variance, [&](std::size_t pixel, int x, int y) {
    Rgb sum;
    int count = 0;
    around(variance, x, y, 1, [&](std::size_t other) { sum += roots.pixels[other], ++count; });
    const Rgb mean = sum / static_cast<float>(count);
    smoothed.pixels[pixel] = mean * mean * mean * mean;
  });
  return smoothed;
}

/// Takes `radiance` without specks and `variance` smoothed.
Planes planes_of(const NoisyImage& image, const Image& radiance, const Image& variance, const Image& divisors) {
  Planes planes{radiance.width, radiance.height, {}};
  for (std::vector<float>& plane : planes.values) plane.resize(radiance.pixels.size());
  for_each_pixel(radiance, [&](std::size_t i, int, int) {
    for (int c = 0; c < 3; ++c) {
      planes.values[static_cast<std::size_t>(c)][i] = radiance.pixels[i][c] / divisors.pixels[i][c];
      planes.values[static_cast<std::size_t>(kNormalX + c)][i] = number(image.normal.pixels[i][c]);
    }
    const Rgb& noise = variance.pixels[i];
    const float depth = image.depth.pixels[i].r;
    planes.values[kVariance][i] = noise.r + noise.g + noise.b;
    planes.values[kNearness][i] = depth < kNoSurface ? number(1 / depth) : 0;
  });
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

/// Moves a mean no farther from the pixel's own value than its noise explains.
float within_noise(float mean, float own, float variance) {
  constexpr float kFar = 4;  // standard deviations
  const float far = kFar * std::sqrt(variance);
  return std::max(own - far, std::min(own + far, mean));
}

/// Returns the nearest pixels and, farther away, every second of every second row: photons blur their noise over more
/// than that, so those between would add little.
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
  const Image divisors = dspm::divisors(image.albedo);
  Unspecked given = without_specks(image.radiance, image.variance, divisors);
  given.variance = smoothed_variance(given.variance, divisors);
  const Planes planes = planes_of(image, given.radiance, given.variance, divisors);
  const std::vector<Offset> offsets = dspm::offsets();
  Image result = std::move(given.radiance);
  const int across = (result.width + Tile::kSide - 1) / Tile::kSide,
            down = (result.height + Tile::kSide - 1) / Tile::kSide;
  parallel_for(across * down, 1, [&](std::int64_t number) {
    const int x = static_cast<int>(number) % across * Tile::kSide, y = static_cast<int>(number) / across * Tile::kSide;
    Tile tile(planes, x, y);
    for (const Offset offset : offsets) tile.add(offset);
    for (int row = 0; row < std::min(Tile::kSide, result.height - y); ++row)
      for (int column = 0; column < std::min(Tile::kSide, result.width - x); ++column) {
        const std::size_t i = result.index(x + column, y + row);
        if (!tile.is_mixed(row, column)) continue;
        Rgb mixed;
        for (int c = 0; c < 3; ++c) {
          const auto plane = static_cast<Plane>(kRed + c);
          mixed[c] = within_noise(tile.mean(plane, row, column), planes.values[plane][i], given.variance.pixels[i][c]) *
                     divisors.pixels[i][c];
        }
        if (is_finite(mixed)) result.pixels[i] = mixed;
      }
  });
  return result;
}

}  // namespace dspm
