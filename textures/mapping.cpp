#include "dspm/textures/mapping.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

/// Returns the angle around z as a fraction of a turn from x, in [0, 1).
float turn(const Vec3& p) {
  const float fraction = rounded::atan2(p.y, p.x) / (2 * kPi);
  return fraction < 0 ? fraction + 1 : fraction;
}

/// Returns s from the pole at +z to the other, and t around the axis, as in pbrt.
Vec2 spherical(const Vec3& p) { return {rounded::atan2(rounded::hypot(p.x, p.y), p.z) / kPi, turn(p)}; }

/// Returns s, which is 0 at -x, as in pbrt, and t, which is the height.
Vec2 cylindrical(const Vec3& p) { return {0.5f + rounded::atan2(p.y, p.x) / (2 * kPi), p.z}; }

/// Returns the change of a turn around z.
float turned(const Vec3& p, const Vec3& dp) { return (p.x * dp.y - p.y * dp.x) / (2 * kPi * (p.x * p.x + p.y * p.y)); }

/// Returns the change of the angle from +z, as a fraction of a half turn.
float tilted(const Vec3& p, const Vec3& dp) {
  const float rho = rounded::hypot(p.x, p.y);
  return ((p.x * dp.x + p.y * dp.y) * (p.z / rho) - rho * dp.z) / (kPi * length2(p));
}

/// Returns the change of (u, v): the least squares solution of dp = dpdu du + dpdv dv. It is in double, as triangles
/// may be tiny. [Pharr, Jakob, Humphreys, Physically Based Rendering, 10.1.1]
Vec2 uv_change(const TexturePoint& at, const Vec3& dp) {
  const double uu = dot(at.dpdu, at.dpdu), uv = dot(at.dpdu, at.dpdv), vv = dot(at.dpdv, at.dpdv);
  const double u = dot(at.dpdu, dp), v = dot(at.dpdv, dp), determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return {};
  return {static_cast<float>((vv * u - uv * v) / determinant), static_cast<float>((uu * v - uv * u) / determinant)};
}

/// Bounds the change: near a pole or an axis coordinates change without bound.
Vec2 bounded(Vec2 change) {
  const auto bound = [](float c) { return std::isnan(c) ? 0 : std::clamp(c, -1e8f, 1e8f); };
  return {bound(change.x), bound(change.y)};
}

VertexData::SecondUv second_uv(const TexturePoint& at) {
  return at.vertices.data->second_uv(at.vertices.triangle, at.vertices.at);
}

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
  const int set = reader.integer("uvset", 1, {}, "of uv: 2 takes a mesh's second texture coordinates");
  if (set != 1 && set != 2) reader.error("uvset", "\"uvset\" must be 1 or 2");
  mapping.second_uv_ = set == 2;
  mapping.scale_.x = reader.number("uscale", 1, {}, "of uv: repetitions of the picture between u = 0 and 1");
  mapping.scale_.y = reader.number("vscale", 1, {}, "of uv: repetitions of the picture between v = 0 and 1");
  mapping.delta_.x = reader.number("udelta", 0, {}, "of uv and planar: shift");
  mapping.delta_.y = reader.number("vdelta", 0, {}, "of uv and planar: shift");
  const float rotation = reader.number("rotation", 0, "degrees", "of uv: from u towards v, after the scale");
  if (rotation != 0) mapping.along_u_ = {rounded::cos(rotation * kPi / 180), rounded::sin(rotation * kPi / 180)};
  mapping.v1_ = reader.vector("v1", {1, 0, 0}, {}, "of planar: the picture's horizontal axis");
  mapping.v2_ = reader.vector("v2", {0, 1, 0}, {}, "of planar: the picture's vertical axis");
  mapping.world_from_texture_ = world_from_texture;
  return mapping;
}

Vec2 TextureMapping::at(const TexturePoint& point) const {
  if (kind_ == Kind::uv) {
    const Vec2 st = turned_uv(takes_second(point) ? second_uv(point).uv : point.uv);
    return {st.x + delta_.x, st.y + delta_.y};
  }
  return at_own(world_from_texture_.inverse_point(point.p));
}

Vec2 TextureMapping::turned_uv(Vec2 uv) const {
  const Vec2 scaled{scale_.x * uv.x, scale_.y * uv.y};
  if (along_u_.y == 0 && along_u_.x == 1) return scaled;
  return {along_u_.x * scaled.x - along_u_.y * scaled.y, along_u_.y * scaled.x + along_u_.x * scaled.y};
}

Vec2 TextureMapping::at_own(const Vec3& p) const {
  if (kind_ == Kind::spherical) return spherical(p);
  if (kind_ == Kind::cylindrical) return cylindrical(p);
  return {dot(p, v1_) + delta_.x, dot(p, v2_) + delta_.y};
}

TextureCoordinates TextureMapping::map(const TexturePoint& point) const {
  if (point.dpdx == Vec3{} && point.dpdy == Vec3{}) return {at(point)};
  return {at(point), bounded(change(point, point.dpdx)), bounded(change(point, point.dpdy))};
}

Vec2 TextureMapping::change(const TexturePoint& point, const Vec3& dp) const {
  if (kind_ == Kind::uv) {
    const Vec2 first = uv_change(point, dp);
    if (!takes_second(point)) return turned_uv(first);
    const auto second = second_uv(point);
    return turned_uv(second.by_u * first.x + second.by_v * first.y);
  }
  const Vec3 p = world_from_texture_.inverse_point(point.p), own = world_from_texture_.inverse_vector(dp);
  if (kind_ == Kind::spherical) return {tilted(p, own), turned(p, own)};
  if (kind_ == Kind::cylindrical) return {turned(p, own), own.z};
  return {dot(own, v1_), dot(own, v2_)};
}

}  // namespace dspm
