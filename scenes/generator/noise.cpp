#include "scenes/generator/noise.h"

#include <cmath>

#include "dspm/base/math/rng.h"

namespace dspm {

float noise(std::uint64_t seed, float x, float y, int columns, int rows) {
  x = (x - std::floor(x)) * static_cast<float>(columns);
  y = (y - std::floor(y)) * static_cast<float>(rows);
  const int i = static_cast<int>(x), k = static_cast<int>(y);
  const auto value = [&](int a, int b) {
    return PathRandom(seed, Stream::setup, static_cast<std::uint64_t>(b % rows), 0).number(a % columns, columns);
  };
  const auto eased = [](float t) { return t * t * t * (t * (6 * t - 15) + 10); };  // [Perlin 2002]
  const float s = eased(x - static_cast<float>(i)), t = eased(y - static_cast<float>(k));
  const float low = value(i, k) * (1 - s) + value(i + 1, k) * s;
  const float high = value(i, k + 1) * (1 - s) + value(i + 1, k + 1) * s;
  return low * (1 - t) + high * t;
}

float layered_noise(std::uint64_t seed, float x, float y, int columns, int rows, int octaves) {
  float sum = 0, weights = 0, weight = 1;
  for (int i = 0; i < octaves; ++i, weight /= 2) {
    sum += weight * noise(seed + static_cast<std::uint64_t>(i), x, y, columns << i, rows << i);
    weights += weight;
  }
  return sum / weights;
}

}  // namespace dspm
