#include "dspm/shapes/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "dspm/shapes/rounding.h"
#include "dspm/system/parallel.h"
#include "dspm/system/parallel_sort.h"

namespace dspm {
namespace {

/// The part of v that is perpendicular to the unit vector `along`, of unit length; any such if nothing is left.
DoubleVec3 perpendicular(const DoubleVec3& v, const DoubleVec3& along) {
  const DoubleVec3 rest = v - along * dot(v, along);
  const double l = length(rest);
  return l > 1e-9 * length(v) ? rest * (1 / l) : widen(Basis::around(narrow(along)).x);
}

/// The lowest 21 bits of v, with two zeros after each.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32) & 0x001f00000000ffffu;
  v = (v | v << 16) & 0x001f0000ff0000ffu;
  v = (v | v << 8) & 0x100f00f00f00f00fu;
  v = (v | v << 4) & 0x10c30c30c30c30c3u;
  return (v | v << 2) & 0x1249249249249249u;
}

/// The bits of the coordinates within the box, interleaved. [Morton 1966]
std::uint64_t place_along_z_curve(const Vec3& p, const Bounds3& box) {
  constexpr int kMost = (1 << 21) - 1;
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float share = (p[axis] - box.low[axis]) / (box.high[axis] - box.low[axis]);
    place |= spread(static_cast<std::uint64_t>(std::clamp(share > 0 ? share : 0, 0.f, 1.f) * kMost)) << axis;
  }
  return place;
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
    : type_(type), segments_(segments.begin(), segments.end()), normals_(std::move(normals)) {
  for (std::uint32_t s = 0; s < segments_.size(); ++s) cut(s, split_depth);
}

/// Halves the pieces as long as their boxes get much smaller: those of slanting curves do, those along an axis do not.
void Curves::cut(std::uint32_t number, int split_depth) {
  constexpr float kWorthwhile = 0.7f;
  const CurveSegment& segment = segments_[number];
  const auto surface = [&](const std::vector<CurvePart>& parts) {
    float sum = 0;
    for (const CurvePart& part : parts) sum += bounds_of(segment, part).half_area();
    return sum;
  };
  static thread_local std::vector<CurvePart> parts, halves;
  parts.assign(1, CurvePart::of(segment, 0, 1));
  float whole = surface(parts);
  for (int depth = 0; depth < split_depth; ++depth) {
    const std::size_t count = 2 * parts.size();
    halves.clear();
    for (std::size_t i = 0; i < count; ++i)
      halves.push_back(CurvePart::of(segment, double(i) / double(count), double(i + 1) / double(count)));
    const float halved = surface(halves);
    if (!(halved < kWorthwhile * whole)) break;
    whole = halved;
    parts.swap(halves);
  }
  if (number == 0) pieces_.reserve(parts.size() * segments_.size());  // others are likely cut alike
  const auto count = static_cast<int>(parts.size());
  for (int i = 0; i < count; ++i)
    pieces_.push_back(CurvePiece::of(segment, number, i, count, parts[static_cast<std::size_t>(i)]));
}

bool Curves::absorb(Shape& next) {
  auto* other = dynamic_cast<Curves*>(&next);
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  if (!other || other->type_ != type_ || pieces_.size() + other->pieces_.size() > kMost) return false;
  const auto first = static_cast<std::uint32_t>(segments_.size());
  segments_.insert(segments_.end(), other->segments_.begin(), other->segments_.end());
  normals_.insert(normals_.end(), other->normals_.begin(), other->normals_.end());
  for (CurvePiece piece : other->pieces_) {
    piece.segment += first;
    pieces_.push_back(piece);
  }
  return true;
}

/// Pieces that lie close together are stored close together, whatever the order of the strands: a ray that passes dense hair
/// waits for memory more than for anything else.
void Curves::settle() {
  constexpr std::int64_t kGrain = 1 << 14;
  Bounds3 all;
  for (const CurvePiece& piece : pieces_) all.add(piece.start);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(pieces_.size());
  const auto for_each_piece = [&](const auto& body) {
    parallel_for(static_cast<std::int64_t>(pieces_.size()), kGrain,
                 [&](std::int64_t i) { body(static_cast<std::size_t>(i)); });
  };
  for_each_piece([&](std::size_t i) {
    order[i] = {place_along_z_curve(pieces_[i].start + pieces_[i].chord * 0.5f, all), static_cast<std::uint32_t>(i)};
  });
  parallel_sort(order);
  std::vector<CurvePiece> pieces(pieces_.size());
  for_each_piece([&](std::size_t i) { pieces[i] = pieces_[order[i].second]; });
  pieces_ = std::move(pieces);
  order = {};

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
    const auto hit = type_ == CurveType::ribbon ? ribbon_hit(piece(primitive).segment, passage, ray)
                                                : facing_hit(segment(primitive), passage, ray);
    if (hit && (!nearest || hit->t < nearest->t)) nearest = hit;
  });
  return nearest;
}

std::optional<PrimitiveHit> Curves::facing_hit(const CurveSegment& segment, const Passage& at, const Ray& ray) const {
  const DoubleVec3 d = widen(ray.direction);
  return hit_at(dot(at.place.p, d) / dot(d, d), at.u, 0.5 + at.offset / segment.width_at(at.u), ray);
}

/// The ribbon is taken for flat around the passage. Where the ray meets its plane lies further along the curve and
/// across it than the passage.
std::optional<PrimitiveHit> Curves::ribbon_hit(std::uint32_t number, const Passage& at, const Ray& ray) const {
  const DoubleVec3 d = widen(ray.direction), tangent = direction_at(segments_[number], at.u);
  const DoubleVec3 normal = perpendicular(normals_[number].between(at.u), tangent), side = cross(normal, tangent);
  const double slope = dot(normal, d);
  if (!(std::abs(slope) > 1e-6 * length(d))) return std::nullopt;
  const double t = dot(normal, at.place.p) / slope;
  const DoubleVec3 from_center = d * t - at.place.p;
  const double across = dot(from_center, side), width = segments_[number].width_at(at.u);
  if (!(std::abs(across) <= width / 2)) return std::nullopt;
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

/// On the plane through the centre line that faces the ray. The normal of a cylinder turns evenly from side to side, as in
/// pbrt. The error bound is not rounding: a ray that leaves on either side of the normal must start beyond everything that
/// turns towards it, which lies within half a width of the centre.
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

/// A bent ribbon is not quite where its tangent plane is, so rays start a twentieth of the width off it.
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

/// Uniform in u and v. As curves emit no light, nothing relies on their area.
Vec2 Curves::sample_area(int primitive, Vec2 u) const {
  const CurvePiece& p = piece(primitive);
  return {p.from() + (p.to() - p.from()) * u.x, u.y};
}

}  // namespace dspm
