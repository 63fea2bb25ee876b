#include "dspm/image/denoise/tile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dspm {
namespace {

// These are in standard deviations. Neighbours share photons, so their noise does not average out within a patch.
constexpr float kColours = 1.5f;
constexpr float kOwn = 3;                          // what noise makes of a pixel's own difference now and then
constexpr float kNormals = 0.3f;                   // a difference of that length
constexpr float kPlane = 0.002f;                   // of nearness, relative, for each pixel of distance
constexpr float kDark = 1e-12f, kNoDepth = 1e-9f;  // against divisions by zero

/// Returns about exp(-x), and 0 from 8 on; it calls no function, so that loops become vectors.
inline float falloff(float x) {
  const float to_8 = std::max(0.f, 1 - x / 8), to_4 = to_8 * to_8, to_2 = to_4 * to_4;
  return to_2 * to_2;
}

inline float square(float x) { return x * x; }

}  // namespace

Tile::Tile(const Planes& planes, int x, int y) {
  constexpr auto kSize = static_cast<std::size_t>(kWidth) * kWidth;
  inside_.resize(kSize);
  for (std::vector<float>& plane : planes_) plane.resize(kSize);
  for (int row = 0; row < kWidth; ++row)
    for (int column = 0; column < kWidth; ++column) {
      const int u = x - kMargin + column, v = y - kMargin + row;
      const int from_x = std::clamp(u, 0, planes.width - 1), from_y = std::clamp(v, 0, planes.height - 1);
      const auto to = static_cast<std::size_t>(row * kWidth + column);
      const auto from =
          static_cast<std::size_t>(from_y) * static_cast<std::size_t>(planes.width) + static_cast<std::size_t>(from_x);
      for (std::size_t i = 0; i < kPlanes; ++i) planes_[i][to] = planes.values[i][from];
      inside_[to] = u == from_x && v == from_y ? 1.f : 0.f;
    }
}

void Tile::add(Offset offset) {
  compare(offset);
  for (int row = 0; row < kCompared; ++row) {
    const float* const differences = &differences_[static_cast<std::size_t>(row * kCompared)];
    float* const sums = &of_rows_[static_cast<std::size_t>(row * kSide)];
    for (int column = 0; column < kSide; ++column) {
      float sum = 0;
      for (int i = 0; i <= 2 * kPatch; ++i) sum += differences[column + i];
      sums[column] = sum;
    }
  }
  for (int row = 0; row < kSide; ++row) add_row(row, offset);
}

/// Compares by the squared difference, less what noise alone would make of it, over that. The lesser noise counts: a
/// firefly has much, and would be like everything. [Rousselle et al. 2012, (5)]
void Tile::compare(Offset offset) {
  for (int row = 0; row < kCompared; ++row) {
    const auto here = [&](Plane plane) { return at(plane, row - kPatch, -kPatch); };
    const auto there = [&](Plane plane) { return at(plane, row - kPatch + offset.y, offset.x - kPatch); };
    const float *const r = here(kRed), *const g = here(kGreen), *const b = here(kBlue), *const v = here(kVariance);
    const float *const r2 = there(kRed), *const g2 = there(kGreen), *const b2 = there(kBlue),
                       *const v2 = there(kVariance);
    float* const differences = &differences_[static_cast<std::size_t>(row * kCompared)];
    for (int i = 0; i < kCompared; ++i) {
      const float noise = 2 * std::min(v[i], v2[i]);
      const float difference = square(r[i] - r2[i]) + square(g[i] - g2[i]) + square(b[i] - b2[i]);
      differences[i] = (difference - noise) / (kColours * kColours * noise + kDark);
    }
  }
}

void Tile::add_row(int row, Offset offset) {
  constexpr float kPatchPixels = (2 * kPatch + 1) * (2 * kPatch + 1);
  const float distance = std::sqrt(static_cast<float>(offset.x * offset.x + offset.y * offset.y));
  const float per_pixel = distance > 0 ? 1 / distance : 0;
  const auto here = [&](Plane plane) { return at(plane, row, 0); };
  const auto there = [&](Plane plane) { return at(plane, row + offset.y, offset.x); };
  const float *const nx = here(kNormalX), *const ny = here(kNormalY), *const nz = here(kNormalZ),
                     *const z = here(kNearness), *const s = here(kSlope);
  const float *const nx2 = there(kNormalX), *const ny2 = there(kNormalY), *const nz2 = there(kNormalZ),
                     *const z2 = there(kNearness), *const s2 = there(kSlope);
  const float *const r = there(kRed), *const g = there(kGreen), *const b = there(kBlue);
  const float* const inside = &inside_[static_cast<std::size_t>(r - planes_[kRed].data())];
  const auto sums = [&](int i) { return &sums_[static_cast<std::size_t>(i)][static_cast<std::size_t>(row * kSide)]; };
  float *const red = sums(0), *const green = sums(1), *const blue = sums(2), *const weights = sums(kWeight);
  const float* const own = &differences_[static_cast<std::size_t>((row + kPatch) * kCompared + kPatch)];
  for (int i = 0; i < kSide; ++i) {
    float patch = 0;
    for (int y = 0; y <= 2 * kPatch; ++y) patch += of_rows_[static_cast<std::size_t>((row + y) * kSide + i)];
    const float bend = square(nx[i] - nx2[i]) + square(ny[i] - ny2[i]) + square(nz[i] - nz2[i]);
    const float step = std::abs(z[i] - z2[i]) * per_pixel / (s[i] + s2[i] + kPlane * (z[i] + z2[i]) + kNoDepth);
    const float by_colour = falloff(std::max({0.f, patch / kPatchPixels, (own[i] - kOwn) / 2}));
    const float by_surface = falloff(bend / (kNormals * kNormals) + square(step) / 2);
    const float weight = std::min(by_colour, by_surface) * inside[i];
    red[i] += weight * r[i], green[i] += weight * g[i], blue[i] += weight * b[i], weights[i] += weight;
  }
}

float Tile::mean(Plane plane, int row, int column) const {
  const auto pixel = static_cast<std::size_t>(row * kSide + column);
  return sums_[static_cast<std::size_t>(plane)][pixel] / sums_[kWeight][pixel];
}

bool Tile::is_mixed(int row, int column) const {
  return sums_[kWeight][static_cast<std::size_t>(row * kSide + column)] > 1;
}

}  // namespace dspm
