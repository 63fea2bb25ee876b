#include "dspm/shapes/curve_segment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/math/rounding.h"
#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

/// The angle by which a curve may turn in a step of the search for rays (radians).
constexpr double kTurnOfStep = 0.25;

DoubleVec3 between(const DoubleVec3& a, const DoubleVec3& b, double t) { return a * (1 - t) + b * t; }

double angle_between(const DoubleVec3& a, const DoubleVec3& b) {
  const double lengths = length(a) * length(b);
  return lengths > 0 ? std::atan2(length(cross(a, b)), dot(a, b)) : 0;
}

/// Returns whether the angle is certainly less than half of what kCurveSteps steps may turn.
bool hardly_turns(const DoubleVec3& a, const DoubleVec3& b) {
  constexpr double kTangent = 0.375;  // atan(0.375) = 0.359
  static_assert(kTangent <= kCurveSteps * kTurnOfStep / 2);
  const double along = dot(a, b);
  const DoubleVec3 across = cross(a, b);
  return along >= 0 && dot(across, across) <= kTangent * kTangent * along * along;
}

/// Returns so many steps that the curve turns little in one. For most pieces of hair, that takes no angle.
int steps_for(const CurvePart& part) {
  const auto& c = part.control;
  const DoubleVec3 a = c[1] - c[0], b = c[2] - c[1], d = c[3] - c[2];
  if (hardly_turns(a, b) && hardly_turns(b, d)) return kCurveSteps;
  const double turn = angle_between(a, b) + angle_between(b, d);
  return kCurveSteps * std::max(1, static_cast<int>(std::ceil(turn / (kCurveSteps * kTurnOfStep))));
}

}  // namespace

/// The control points are the blossom of the segment for (a, a, a), (a, a, b), (a, b, b) and (b, b, b).
/// [Ramshaw 1987, Blossoming]
CurvePart CurvePart::of(const CurveSegment& s, double a, double b) {
  using Step = std::array<DoubleVec3, 3>;
  const DoubleVec3 c[] = {s.control(0), s.control(1), s.control(2), s.control(3)};
  const auto first = [&](double u) {
    return Step{between(c[0], c[1], u), between(c[1], c[2], u), between(c[2], c[3], u)};
  };
  const auto rest = [](const Step& p, double v, double w) {
    return between(between(p[0], p[1], v), between(p[1], p[2], v), w);
  };
  const Step at_a = first(a);
  return {a, b, {rest(at_a, a, a), rest(at_a, a, b), rest(at_a, b, b), rest(first(b), b, b)}};
}

CurveSegment CurveSegment::of(const Vec3 (&p)[4], float width0, float width1) {
  CurveSegment s{};
  for (int k = 0; k < 4; ++k) s.x[k] = p[k].x, s.y[k] = p[k].y, s.z[k] = p[k].z;
  s.width[0] = width0, s.width[1] = width1;
  return s;
}

CurvePlace place_on(const CurveSegment& s, double u, const Vec3& origin) {
  const DoubleVec3 o = widen(origin);
  const DoubleVec3 a = s.control(0) - o, b = s.control(1) - o, c = s.control(2) - o, d = s.control(3) - o;
  const DoubleVec3 ab = between(a, b, u), bc = between(b, c, u), cd = between(c, d, u);
  const DoubleVec3 abc = between(ab, bc, u), bcd = between(bc, cd, u);
  const DoubleVec3 bend0 = a - b * 2 + c, bend1 = b - c * 2 + d;
  return {between(abc, bcd, u), (bcd - abc) * 3, between(bend0, bend1, u) * 6};
}

DoubleVec3 direction_at(const CurveSegment& s, double u) {
  constexpr double kInside = 0.01;
  const DoubleVec3 chord = s.control(3) - s.control(0);
  for (const DoubleVec3& d : {place_on(s, u, {}).d1, place_on(s, u < 0.5 ? u + kInside : u - kInside, {}).d1, chord})
    if (const double l = length(d); l > 1e-6 * length(chord) && l > 0) return d * (1 / l);
  return {0, 0, 1};
}

Bounds3 bounds_of(const CurveSegment& segment, const CurvePart& part) {
  Bounds3 bounds;
  for (const DoubleVec3& p : part.control) bounds.add(narrow(p));
  const auto width =
      static_cast<float>(std::max(segment.width_at(part.from), segment.width_at(part.to)) / 2 * (1 + 1e-6));
  const Vec3 margin = gamma_bound(2) * max(abs(bounds.low), abs(bounds.high)) + Vec3{width, width, width};
  return {bounds.low - margin, bounds.high + margin};
}

CurvePiece CurvePiece::of(const CurveSegment& segment, std::uint32_t number, int index, int count,
                          const CurvePart& part) {
  CurvePiece piece{number, static_cast<std::uint16_t>(index), static_cast<std::uint16_t>(count),
                   static_cast<std::uint16_t>(steps_for(part))};
  const auto& c = part.control;
  const DoubleVec3 chord = c[3] - c[0];
  const double length2 = dot(chord, chord);
  double bulge = 0;
  for (const DoubleVec3& p : c) {
    const DoubleVec3 along = length2 > 0 ? chord * (dot(p - c[0], chord) / length2) : DoubleVec3{0, 0, 0};
    bulge = std::max(bulge, length(p - c[0] - along));
  }
  const double radius = std::max(segment.width_at(part.from), segment.width_at(part.to)) / 2;
  piece.start = narrow(c[0]), piece.chord = narrow(chord), piece.reach = static_cast<float>((radius + bulge) * 1.001);
  return piece;
}

}  // namespace dspm
