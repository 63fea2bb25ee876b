// One segment of a curve, a cubic Bezier curve whose width varies linearly, and where rays pass it. A piece of it is
// what trees bound and rays are tested against.
#pragma once

#include <cmath>
#include <cstdint>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/double_vec.h"

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

}  // namespace dspm
