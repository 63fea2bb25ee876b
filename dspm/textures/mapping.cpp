#include "dspm/textures/mapping.h"

#include <cmath>

#include "dspm/math/vec.h"

namespace dspm {
namespace {

/// The angle around z as a fraction of a turn from x, in [0, 1).
float turn(const Vec3& p) {
  const float fraction = std::atan2(p.y, p.x) / (2 * kPi);
  return fraction < 0 ? fraction + 1 : fraction;
}

/// s runs from the pole at +z to the other, and t around the axis, as in pbrt.
Vec2 spherical(const Vec3& p) { return {std::atan2(std::hypot(p.x, p.y), p.z) / kPi, turn(p)}; }

/// s is 0 at -x, as in pbrt; t is the height.
Vec2 cylindrical(const Vec3& p) { return {0.5f + std::atan2(p.y, p.x) / (2 * kPi), p.z}; }

TextureMapping::Kind kind_of(const std::string& word) {
  using Kind = TextureMapping::Kind;
  return word == "spherical"     ? Kind::spherical
         : word == "cylindrical" ? Kind::cylindrical
         : word == "planar"      ? Kind::planar
                                 : Kind::uv;
}

}  // namespace

TextureMapping TextureMapping::read(ParamReader& reader, const Transform& world_from_texture) {
  TextureMapping mapping;
  mapping.kind_ =
      kind_of(reader.choice("mapping", "uv", {"uv", "spherical", "cylindrical", "planar"}, "from surface to picture"));
  mapping.scale_.x = reader.number("uscale", 1, {}, "of uv: repetitions of the picture between u = 0 and 1");
  mapping.scale_.y = reader.number("vscale", 1, {}, "of uv: repetitions of the picture between v = 0 and 1");
  mapping.delta_.x = reader.number("udelta", 0, {}, "of uv and planar: shift");
  mapping.delta_.y = reader.number("vdelta", 0, {}, "of uv and planar: shift");
  mapping.v1_ = reader.vector("v1", {1, 0, 0}, {}, "of planar: the picture's horizontal axis");
  mapping.v2_ = reader.vector("v2", {0, 1, 0}, {}, "of planar: the picture's vertical axis");
  mapping.world_from_texture_ = world_from_texture;
  return mapping;
}

Vec2 TextureMapping::at(const TexturePoint& point) const {
  if (kind_ == Kind::uv) return {scale_.x * point.uv.x + delta_.x, scale_.y * point.uv.y + delta_.y};
  const Vec3 p = world_from_texture_.inverse_point(point.p);
  if (kind_ == Kind::spherical) return spherical(p);
  if (kind_ == Kind::cylindrical) return cylindrical(p);
  return {dot(p, v1_) + delta_.x, dot(p, v2_) + delta_.y};
}

}  // namespace dspm
