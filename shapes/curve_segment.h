// One segment of a curve, a cubic Bezier curve whose width varies linearly, and where rays pass it. A piece of it is
// what trees bound and rays are tested against: four places are tried at a time in float, then Newton's steps in double
// decide.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {

struct CurveSegment {
  float x[4], y[4], z[4];  // of the control points
  float width[2];          // at its ends

  static CurveSegment of(const Vec3 (&points)[4], float width0, float width1);
  DoubleVec3 control(int k) const { return {x[k], y[k], z[k]}; }
  double width_at(double u) const { return width[0] + u * (double{width[1]} - width[0]); }
};

/// The centre line, seen from some origin: its place, and derivatives by u.
struct CurvePlace {
  DoubleVec3 p, d1, d2;
};
CurvePlace place_on(const CurveSegment& segment, double u, const Vec3& origin);
/// Returns the direction, of unit length; that of the chord where the curve stands still.
DoubleVec3 direction_at(const CurveSegment& segment, double u);

/// The part between two places of a segment, as a curve of its own.
struct CurvePart {
  double from, to;
  DoubleVec3 control[4];

  static CurvePart of(const CurveSegment& segment, double from, double to);
};

/// The steps of a piece are a multiple of this: four places are tried at a time.
inline constexpr int kCurveSteps = 3;

/// A piece from u = index / count to (index + 1) / count.
struct CurvePiece {
  std::uint32_t segment;
  std::uint16_t index, count;
  std::uint16_t steps = 0;      // in which rays look for it, so small that it hardly bends in one
  Vec3 start = {}, chord = {};  // between its ends
  float reach = 0;              // from the chord: contains the piece with its width

  /// Makes a piece of segment `number`, with its steps and what the first test of a ray needs. `part` is the piece as a
  /// curve of its own.
  static CurvePiece of(const CurveSegment& segment, std::uint32_t number, int index, int count, const CurvePart& part);
  /// Returns false if the ray's line stays away from the chord further than the piece does. A few multiplications spare
  /// most rays everything else.
  bool may_meet(const Ray& ray) const {
    const Vec3 from = start - ray.origin, normal = cross(ray.direction, chord);
    const float rounding = 1e-6f * (std::abs(from.x) + std::abs(from.y) + std::abs(from.z));
    const float distance = dot(from, normal), most = reach + rounding;
    return !(distance * distance > most * most * length2(normal));
  }

  float from() const { return static_cast<float>(index) / static_cast<float>(count); }
  float to() const { return static_cast<float>(index + 1) / static_cast<float>(count); }
};

/// Returns a box that contains that part with its width, rounding included.
Bounds3 bounds_of(const CurveSegment& segment, const CurvePart& part);

/// The place where the line of a ray passes the centre line of a curve most closely, for one of its turns.
struct Passage {
  double u;
  CurvePlace place;   // of the centre line, from the ray's origin
  DoubleVec3 across;  // of unit length, perpendicular to ray and curve: d x tangent
  double offset;      // the ray's from the centre line, against `across`
};

/// A segment projected along a ray, which passes at (0, 0): p(u) = ((c3 u + c2) u + c1) u + c0.
struct ProjectedCurve {
  float x[4], y[4];  // coefficients, the constant first

  ProjectedCurve(const CurveSegment& s, const Ray& ray) {
    const Basis basis = Basis::around(normalize(ray.direction));
    project(s, ray.origin, basis.x, x);
    project(s, ray.origin, basis.y, y);
  }

  Vec2 at(float u) const { return {polynomial(x, u), polynomial(y, u)}; }
  float length_of_tangent(float u) const { return rounded::hypot(derivative(x, u), derivative(y, u)); }

  /// Returns Newton's step towards the nearest place between two others.
  float nearer(float u, float low, float high) const {
    const Vec2 p = at(u), d{derivative(x, u), derivative(y, u)};
    const float slope = d.x * d.x + d.y * d.y + p.x * (6 * x[3] * u + 2 * x[2]) + p.y * (6 * y[3] * u + 2 * y[2]);
    return slope > 0 ? std::clamp(u - (p.x * d.x + p.y * d.y) / slope, low, high) : u;
  }

  static float polynomial(const float* c, float u) { return ((c[3] * u + c[2]) * u + c[1]) * u + c[0]; }
  static float derivative(const float* c, float u) { return (3 * c[3] * u + 2 * c[2]) * u + c[1]; }

 private:
  static void project(const CurveSegment& s, const Vec3& origin, const Vec3& axis, float* c) {
    float p[4];
    for (int k = 0; k < 4; ++k)
      p[k] = (s.x[k] - origin.x) * axis.x + (s.y[k] - origin.y) * axis.y + (s.z[k] - origin.z) * axis.z;
    c[0] = p[0];
    c[1] = 3 * (p[1] - p[0]);
    c[2] = 3 * ((p[0] - p[1]) + (p[2] - p[1]));
    c[3] = (p[3] - p[0]) + 3 * (p[1] - p[2]);
  }
};

/// Solves (p . p') = 0 by Newton's method, in projection along d, between two places.
inline Passage passage_near(const CurveSegment& segment, const Ray& ray, double u, double low, double high) {
  constexpr int kNewtonSteps = 3;
  const DoubleVec3 d = widen(ray.direction);
  const double dd = dot(d, d);
  const auto projected = [&](const DoubleVec3& a, const DoubleVec3& b) {
    return dot(a, b) - dot(a, d) * dot(b, d) / dd;
  };
  CurvePlace at = place_on(segment, u, ray.origin);
  for (int n = 0; n < kNewtonSteps; ++n) {
    const double slope = projected(at.d1, at.d1) + projected(at.p, at.d2);
    if (!(slope > 0)) break;
    u = std::clamp(u - projected(at.p, at.d1) / slope, low, high);
    at = place_on(segment, u, ray.origin);
  }
  const DoubleVec3 away = at.p - d * (dot(at.p, d) / dd), across = cross(d, at.d1);
  const double distance = length(away), scale = length(across);
  if (!(scale > 0)) return {u, at, {}, distance};
  return {u, at, across * (1 / scale), std::copysign(distance, dot(away, across))};
}

/// Calls fn(const Passage&) for each turn at which the piece passes within half of its width of the ray's line. The
/// sign of (p . p') decides, with p in projection along the ray, at places that neighbouring steps share, so none is
/// lost between them; neighbouring pieces overlap by a thousandth of the width.
template <class Fn>
void for_each_passage(const CurveSegment& segment, const CurvePiece& piece, const Ray& ray, const Fn& fn) {
  const ProjectedCurve curve(segment, ray);
  const float from = piece.from(), to = piece.to(), step = (to - from) / static_cast<float>(piece.steps);
  const float reach = 0.5f * std::max(segment.width[0], segment.width[1]), overlap = 1e-3f * reach;
  for (int first = 0; first < piece.steps; first += kCurveSteps) {
    float u[kCurveSteps + 1], approach[kCurveSteps + 1];  // at each place: above 0 while the curve comes nearer
    for (int j = 0; j <= kCurveSteps; ++j) u[j] = from + static_cast<float>(first + j) * step;
    const bool last = first + kCurveSteps >= piece.steps;
    if (last) u[kCurveSteps] = to;
    for (int j = 0; j <= kCurveSteps; ++j)
      approach[j] = -(curve.polynomial(curve.x, u[j]) * curve.derivative(curve.x, u[j]) +
                      curve.polynomial(curve.y, u[j]) * curve.derivative(curve.y, u[j]));
    if (first == 0 && approach[0] < 0) approach[0] += overlap * curve.length_of_tangent(from);
    if (last && approach[kCurveSteps] > 0) approach[kCurveSteps] -= overlap * curve.length_of_tangent(to);
    for (int j = 0; j < kCurveSteps; ++j) {
      if (!(approach[j] >= 0 && approach[j + 1] <= 0)) continue;
      const float both = approach[j] - approach[j + 1], share = both > 0 ? approach[j] / both : 0.5f;
      const float guess = curve.nearer(u[j] + (u[j + 1] - u[j]) * share, u[j], u[j + 1]);
      // Newton's further steps change the distance by less than this.
      const float near = reach + 0.02f * (u[j + 1] - u[j]) * curve.length_of_tangent(guess);
      const Vec2 p = curve.at(guess);
      if (p.x * p.x + p.y * p.y > near * near) continue;
      const Passage passage = passage_near(segment, ray, guess, u[j], u[j + 1]);
      if (std::abs(passage.offset) <= segment.width_at(passage.u) / 2) fn(passage);
    }
  }
}

}  // namespace dspm
