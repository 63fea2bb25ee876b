// sky.exr: the radiance of an afternoon sky with a low sun, thin clouds and a brown ground, latitude and longitude, +z
// up. The sun is a disk of 2 degrees around azimuth 50 and height 35 degrees; it gives about three times the light of the
// sky.
#include <algorithm>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "scenes/generator/noise.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace {

constexpr int kWidth = 512, kHeight = 256;
constexpr float kDegree = kPi / 180, kSunRadius = 2 * kDegree, kSunRadiance = 2400;

Vec3 direction(float azimuth, float height) {
  return {std::cos(height) * std::cos(azimuth), std::cos(height) * std::sin(azimuth), std::sin(height)};
}

/// x from left to right, y from the zenith down, in 0..1.
Rgb radiance(float x, float y) {
  const float azimuth = 2 * kPi * x, height = kPi * (0.5f - y);
  if (height < 0) return Rgb(.16f, .12f, .09f) * (1 - 0.5f * std::sin(-height));
  const float from_sun =
      std::acos(std::clamp(dot(direction(azimuth, height), direction(50 * kDegree, 35 * kDegree)), -1.f, 1.f));
  if (from_sun < kSunRadius) return Rgb(1, .88f, .7f) * kSunRadiance;
  const float haze = std::pow(1 - std::sin(height), 4.f), glow = std::exp(-3 * from_sun);
  const Rgb blue = Rgb(.22f, .38f, .75f) * (1 - haze) + Rgb(.75f, .8f, .85f) * haze + Rgb(1.4f, 1.1f, .8f) * glow;
  const float cloud = std::clamp(2.4f * layered_noise(5, x, y, 6, 10, 4) - 1.2f, 0.f, 1.f) * std::min(1.f, 4 * height);
  return blue * (1 - cloud) + Rgb(.95f, .95f, .97f) * (cloud * (0.9f + 2 * glow));
}

}  // namespace

void make_sky(const std::filesystem::path& directory) {
  Image image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      image.at(x, y) = radiance((static_cast<float>(x) + 0.5f) / kWidth, (static_cast<float>(y) + 0.5f) / kHeight);
  write_exr(directory / "sky.exr", image, {});
}

}  // namespace dspm
