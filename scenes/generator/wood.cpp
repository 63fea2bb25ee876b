// grain.png: how dark wood is, from 0 to 1 (in linear values), for textures that mix two browns. The picture repeats
// and stands for 20 cm across the grain (left to right) and 80 cm along it.
#include <algorithm>
#include <cmath>

#include "dspm/image/png.h"
#include "scenes/generator/noise.h"
#include "scenes/generator/picture.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace {

constexpr int kWidth = 512, kHeight = 1024, kRings = 18;

/// Early wood is pale and turns slowly into the dark line that ends a year.
float rings(float x, float y) {
  const float year = kRings * x + 5 * layered_noise(1, x, y, 3, 2, 3) + 0.5f * noise(7, x, y, 24, 10);
  return std::pow(year - std::floor(year), 2.5f);
}

float pores(float x, float y) { return std::clamp((noise(11, x, y, 220, 36) - 0.72f) * 5, 0.f, 1.f); }

float grain(float x, float y) {
  const float fibres = noise(13, x, y, 256, 14), cloudy = layered_noise(17, x, y, 3, 2, 2);
  return std::clamp(0.42f * rings(x, y) + 0.34f * fibres + 0.28f * cloudy + 0.2f * pores(x, y) - 0.08f, 0.f, 1.f);
}

}  // namespace

void make_wood(const std::filesystem::path& directory) {
  write_png(directory / "grain.png", picture(kWidth, kHeight, grain));
}

}  // namespace dspm
