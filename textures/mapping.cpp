#include "dspm/textures/mapping.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

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

PlainMapping::Kind kind_of(const std::string& word) {
  using Kind = PlainMapping::Kind;
  return word == "spherical"     ? Kind::spherical
         : word == "cylindrical" ? Kind::cylindrical
         : word == "planar"      ? Kind::planar
                                 : Kind::uv;
}

}  // namespace

TextureMapping TextureMapping::read(ParamReader& reader, const Transform& world_from_texture) {
  TextureMapping mapping;
  PlainMapping& plain = mapping.plain_;
  plain.kind =
      kind_of(reader.choice("mapping", "uv", {"uv", "spherical", "cylindrical", "planar"}, "from surface to picture"));
  const int set = reader.integer("uvset", 1, {}, "of uv: 2 takes a mesh's second texture coordinates");
  if (set != 1 && set != 2) reader.error("uvset", "\"uvset\" must be 1 or 2");
  mapping.second_uv_ = set == 2;
  plain.scale.x = reader.number("uscale", 1, {}, "of uv: repetitions of the picture between u = 0 and 1");
  plain.scale.y = reader.number("vscale", 1, {}, "of uv: repetitions of the picture between v = 0 and 1");
  plain.delta.x = reader.number("udelta", 0, {}, "of uv and planar: shift");
  plain.delta.y = reader.number("vdelta", 0, {}, "of uv and planar: shift");
  const float rotation = reader.number("rotation", 0, "degrees", "of uv: from u towards v, after the scale");
  if (rotation != 0) plain.along_u = {rounded::cos(rotation * kPi / 180), rounded::sin(rotation * kPi / 180)};
  plain.v1 = reader.vector("v1", {1, 0, 0}, {}, "of planar: the picture's horizontal axis");
  plain.v2 = reader.vector("v2", {0, 1, 0}, {}, "of planar: the picture's vertical axis");
  plain.world_from_texture = world_from_texture;
  return mapping;
}

Vec2 TextureMapping::at(const TexturePoint& point) const {
  return plain_.at({point.p, takes_second(point) ? second_uv(point).uv : point.uv});
}

TextureCoordinates TextureMapping::map(const TexturePoint& point) const {
  if (point.dpdx == Vec3{} && point.dpdy == Vec3{}) return {at(point)};
  return {at(point), bounded(change(point, point.dpdx)), bounded(change(point, point.dpdy))};
}

Vec2 TextureMapping::change(const TexturePoint& point, const Vec3& dp) const {
  if (plain_.kind == PlainMapping::Kind::uv) {
    const Vec2 first = uv_change(point, dp);
    if (!takes_second(point)) return plain_.turned_uv(first);
    const auto second = second_uv(point);
    return plain_.turned_uv(second.by_u * first.x + second.by_v * first.y);
  }
  const Vec3 p = plain_.world_from_texture.inverse_point(point.p), own = plain_.world_from_texture.inverse_vector(dp);
  if (plain_.kind == PlainMapping::Kind::spherical) return {tilted(p, own), turned(p, own)};
  if (plain_.kind == PlainMapping::Kind::cylindrical) return {turned(p, own), own.z};
  return {dot(own, plain_.v1), dot(own, plain_.v2)};
}

}  // namespace dspm
