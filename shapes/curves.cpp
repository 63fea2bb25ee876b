#include "dspm/shapes/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "dspm/base/math/rounding.h"
#include "dspm/shapes/curve_pieces.h"

namespace dspm {
namespace {

/// Returns the part of v that is perpendicular to the unit vector `along`, of unit length; any such vector if nothing
/// is left.
DoubleVec3 perpendicular(const DoubleVec3& v, const DoubleVec3& along) {
  const DoubleVec3 rest = v - along * dot(v, along);
  const double l = length(rest);
  return l > 1e-9 * length(v) ? rest * (1 / l) : widen(Basis::around(narrow(along)).x);
}

std::optional<PrimitiveHit> hit_at(double t, double u, double v, const Ray& ray) {
  const auto near = static_cast<float>(t);
  if (!(near > 0 && near < ray.t_max && near < kInfinity)) return std::nullopt;
  return PrimitiveHit{near, {static_cast<float>(u), static_cast<float>(std::clamp(v, 0.0, 1.0))}};
}

SurfacePoint point_at(const DoubleVec3& p, const DoubleVec3& normal, const DoubleVec3& dpdu, Vec2 uv) {
  SurfacePoint point;
  point.p = narrow(p);
  point.ng = point.ns = narrow(normal);
  point.dpdu = narrow(dpdu);
  point.uv = uv;
  point.turns = true;
  return point;
}

}  // namespace

DoubleVec3 RibbonNormals::between(double u) const {
  const DoubleVec3 a = widen(at[0]), b = widen(at[1]);
  const double angle = std::acos(std::clamp(dot(a, b), 0.0, 1.0)), sine = std::sin(angle);
  if (!(sine > 1e-6)) return a;
  return a * (std::sin((1 - u) * angle) / sine) + b * (std::sin(u * angle) / sine);
}

Curves::Curves(CurveType type, std::span<const CurveSegment> segments, std::vector<RibbonNormals> normals,
               int split_depth)
    : type_(type),
      segments_(segments.begin(), segments.end()),
      normals_(std::move(normals)),
      split_depths_(segments.size(), static_cast<std::uint8_t>(split_depth)),
      most_pieces_(segments.size() << split_depth) {}

bool Curves::absorb(Shape& next) {
  auto* other = dynamic_cast<Curves*>(&next);
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  if (!other || other->type_ != type_ || most_pieces_ + other->most_pieces_ > kMost) return false;
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(segments_, other->segments_), append(normals_, other->normals_), append(split_depths_, other->split_depths_);
  most_pieces_ += other->most_pieces_;
  return true;
}

/// Stores segments in the order in which their pieces are.
void Curves::settle() {
  pieces_ = cut_into_pieces(segments_, split_depths_);
  split_depths_ = {};
  constexpr auto kNotPlaced = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(segments_.size(), kNotPlaced);
  std::vector<CurveSegment> segments;
  std::vector<RibbonNormals> normals;
  segments.reserve(segments_.size()), normals.reserve(normals_.size());
  for (CurvePiece& piece : pieces_) {
    std::uint32_t& to = place[piece.segment];
    if (to == kNotPlaced) {
      to = static_cast<std::uint32_t>(segments.size());
      segments.push_back(segments_[piece.segment]);
      if (!normals_.empty()) normals.push_back(normals_[piece.segment]);
    }
    piece.segment = to;
  }
  segments_ = std::move(segments), normals_ = std::move(normals);
}

Bounds3 Curves::bounds(int primitive) const {
  return bounds_of(segment(primitive),
                   CurvePart::of(segment(primitive), piece(primitive).from(), piece(primitive).to()));
}

std::optional<PrimitiveHit> Curves::intersect(int primitive, const Ray& ray) const {
  std::optional<PrimitiveHit> nearest;
  if (!piece(primitive).may_meet(ray)) return nearest;
  for_each_passage(segment(primitive), piece(primitive), ray, [&](const Passage& passage) {
    const auto hit =
        type_ == CurveType::ribbon ? ribbon_hit(primitive, passage, ray) : facing_hit(segment(primitive), passage, ray);
    if (hit && (!nearest || hit->t < nearest->t)) nearest = hit;
  });
  return nearest;
}

std::optional<PrimitiveHit> Curves::facing_hit(const CurveSegment& segment, const Passage& at, const Ray& ray) const {
  const DoubleVec3 d = widen(ray.direction);
  return hit_at(dot(at.place.p, d) / dot(d, d), at.u, 0.5 + at.offset / segment.width_at(at.u), ray);
}

/// Takes the ribbon for flat around the passage. The ray meets its plane further along the curve and across it than the
/// passage; outside of the piece's box, where no tree looks for it, it meets nothing.
std::optional<PrimitiveHit> Curves::ribbon_hit(int primitive, const Passage& at, const Ray& ray) const {
  const std::uint32_t number = piece(primitive).segment;
  const DoubleVec3 d = widen(ray.direction), tangent = direction_at(segments_[number], at.u);
  const DoubleVec3 normal = perpendicular(normals_[number].between(at.u), tangent), side = cross(normal, tangent);
  const double slope = dot(normal, d);
  if (!(std::abs(slope) > 1e-6 * length(d))) return std::nullopt;
  const double t = dot(normal, at.place.p) / slope;
  const DoubleVec3 from_center = d * t - at.place.p;
  const double across = dot(from_center, side), width = segments_[number].width_at(at.u);
  if (!(std::abs(across) <= width / 2)) return std::nullopt;
  const Vec3 p = ray.at(static_cast<float>(t));
  if (const Bounds3 box = bounds(primitive); min(p, box.low) != box.low || max(p, box.high) != box.high)
    return std::nullopt;
  const double speed = length(at.place.d1), along = speed > 0 ? dot(from_center, tangent) / speed : 0;
  return hit_at(t, std::clamp(at.u + along, 0.0, 1.0), 0.5 + across / width, ray);
}

SurfacePoint Curves::surface_point(int primitive, Vec2 uv) const {
  const DoubleVec3 tangent = direction_at(segment(primitive), static_cast<double>(uv.x));
  return seen(primitive, uv, Basis::around(narrow(tangent)).x);
}

SurfacePoint Curves::seen(int primitive, Vec2 uv, const Vec3& direction) const {
  return type_ == CurveType::ribbon ? ribbon_point(piece(primitive).segment, uv)
                                    : facing_point(segment(primitive), uv, direction);
}

/// Returns a point on the plane through the centre line that faces the ray. The normal of a cylinder turns evenly from
/// side to side, as in pbrt. The error bound is not rounding: a ray that leaves on either side of the normal must start
/// beyond everything that turns towards it, which lies within half a width of the centre.
SurfacePoint Curves::facing_point(const CurveSegment& segment, Vec2 uv, const Vec3& direction) const {
  const double u = static_cast<double>(uv.x), v = static_cast<double>(uv.y) - 0.5, width = segment.width_at(u);
  const DoubleVec3 tangent = direction_at(segment, u), facing = perpendicular(widen(-direction), tangent);
  const DoubleVec3 side = cross(facing, tangent);
  const CurvePlace center = place_on(segment, u, {});
  const double angle = type_ == CurveType::cylinder ? v * std::numbers::pi : 0;
  const DoubleVec3 normal = facing * std::cos(angle) + side * std::sin(angle);
  const DoubleVec3 p = center.p + side * (v * width);
  SurfacePoint point = point_at(p, normal, tangent * std::max(length(center.d1), 1e-30), uv);
  const double beyond = (width / 2 + std::abs(v * width * std::sin(angle))) * (1 + 1e-3);
  point.p_error = static_cast<float>(beyond) * abs(point.ng) + gamma_bound(4) * abs(point.p);
  return point;
}

/// Returns a point of a ribbon. A bent one is not quite where its tangent plane is, so rays start a twentieth of the
/// width off it.
SurfacePoint Curves::ribbon_point(std::uint32_t number, Vec2 uv) const {
  constexpr double kOff = 0.05;
  const CurveSegment& segment = segments_[number];
  const double u = static_cast<double>(uv.x), v = static_cast<double>(uv.y) - 0.5, width = segment.width_at(u);
  const DoubleVec3 tangent = direction_at(segment, u);
  const DoubleVec3 normal = perpendicular(normals_[number].between(u), tangent), side = cross(normal, tangent);
  const CurvePlace center = place_on(segment, u, {});
  SurfacePoint point =
      point_at(center.p + side * (v * width), normal, tangent * std::max(length(center.d1), 1e-30), uv);
  point.p_error = static_cast<float>(kOff * width) * abs(point.ng) + gamma_bound(4) * abs(point.p);
  return point;
}

Strip Curves::strip(int primitive, Vec2 uv, const Vec3& direction) const {
  const CurveSegment& s = segment(primitive);
  const std::uint32_t number = piece(primitive).segment;
  const double u = static_cast<double>(uv.x), width = s.width_at(u);
  const DoubleVec3 tangent = direction_at(s, u), towards = widen(-direction);
  const DoubleVec3 normal = perpendicular(type_ == CurveType::ribbon ? normals_[number].between(u) : towards, tangent);
  const double speed = std::max(length(place_on(s, u, {}).d1), 1e-30);
  return {static_cast<int>(number), narrow(tangent * speed), narrow(cross(normal, tangent) * width)};
}

float Curves::area(int primitive) const {
  constexpr int kChords = 8;
  const CurveSegment& s = segment(primitive);
  const CurvePiece& p = piece(primitive);
  const auto u = [&](int i) { return p.from() + (p.to() - p.from()) * static_cast<float>(i) / kChords; };
  double sum = 0;
  for (int i = 0; i < kChords; ++i) {
    const double a = static_cast<double>(u(i)), b = static_cast<double>(u(i + 1));
    sum += length(place_on(s, b, {}).p - place_on(s, a, {}).p) * s.width_at((a + b) / 2);
  }
  return static_cast<float>(sum);
}

/// Draws uniformly in u and v. As curves emit no light, nothing relies on their area.
Vec2 Curves::sample_area(int primitive, Vec2 u) const {
  const CurvePiece& p = piece(primitive);
  return {p.from() + (p.to() - p.from()) * u.x, u.y};
}

}  // namespace dspm
