#include "dspm/cameras/blades.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sampling.h"

namespace dspm {
namespace {

/// Of a regular polygon in the unit circle, one of whose edges has its middle in the direction `rotation`.
Vec2 in_polygon(int corners, float rotation, Vec2 u) {
  const float wedge = std::min(std::floor(u.x * static_cast<float>(corners)), static_cast<float>(corners - 1));
  const float out = std::sqrt(std::clamp(u.x * static_cast<float>(corners) - wedge, 0.f, 1.f));
  const float half = kPi / static_cast<float>(corners), middle = rotation + 2 * half * wedge;
  const Vec2 first{rounded::cos(middle - half), rounded::sin(middle - half)};
  const Vec2 second{rounded::cos(middle + half), rounded::sin(middle + half)};
  return (first * (1 - u.y) + second * u.y) * out;
}

}  // namespace

Blades::Blades(ParamReader& reader)
    : count_(reader.integer("blades", 0, {}, "of the aperture, which make highlights polygons; 0: they are round")),
      rotation_(reader.number("bladerotation", 0, "degrees", "of the polygon, anticlockwise as the camera sees it") *
                kPi / 180) {
  float ratio =
      reader.number("anamorphic", 1, {}, "height over width of the lens' opening; its longer axis is the lens'");
  if (count_ != 0 && (count_ < 3 || count_ > 100)) {
    reader.error("blades", "parameter \"blades\" of " + reader.subject() + " must be 0, or from 3 to 100");
    count_ = 0;
  }
  if (!(ratio > 0)) {
    reader.error("anamorphic", "parameter \"anamorphic\" of " + reader.subject() + " must be above 0");
    ratio = 1;
  }
  width_ = std::min(1 / ratio, 1.f), height_ = std::min(ratio, 1.f);
}

Vec2 Blades::within(Vec2 u) const {
  if (count_ == 0 && width_ == height_) return u;
  const Vec2 place = count_ == 0 ? concentric_disk(u) : in_polygon(count_, rotation_, u);
  return concentric_disk_numbers({place.x * width_, place.y * height_});
}

}  // namespace dspm
