// Light on a surface that turns to each ray, such as a curve. It has no area of its own, but the strip that it shows to
// a beam has: where light arrives from w with irradiance E across the beam, du dv of the strip p(u, v) receives
//
//   E |w . (dp/du x dp/dv)| du dv.
//
// So photons on a strip tell E, and a point that another ray sees on the surface scatters f |cos(w, ns)| E.
#pragma once

#include <algorithm>
#include <cmath>

#include "dspm/base/math/vec.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// A place on a strip, as one ray sees it.
struct StripPlace {
  int shape, strip;    // the placed shape's number, and the strip's in it
  Vec2 uv;             // in [0, 1]
  Vec3 along, across;  // derivatives of p by uv

  /// Takes the direction `towards` the ray's origin.
  StripPlace(const PlacedShape& placed, const RayHit& hit, const Vec3& towards) : shape(hit.shape), uv(hit.uv) {
    const Strip seen = placed.strip(hit.primitive, hit.uv, -towards);
    strip = seen.number, along = seen.along, across = seen.across;
  }
};

/// The points of a strip whose photons count for one that is seen: a rectangle of u and v, as wide as a circle of that
/// radius, less what reaches beyond the strip.
class StripKernel {
 public:
  StripKernel(const StripPlace& seen, float radius)
      : seen_(seen), reach_{reach(radius, seen.along), reach(radius, seen.across)} {}

  /// All photons that count lie between low() and high(), by u.
  float low() const { return seen_.uv.x - reach_.x - most_shift(); }
  float high() const { return seen_.uv.x + reach_.x + most_shift(); }

  /// Returns the irradiance across the beam that a photon from wi stands for, per flux; 0 if it does not count.
  float irradiance(const StripPlace& photon, const Vec3& wi) const {
    const Vec3 normal = cross(photon.along, photon.across);
    const float area = dot(wi, normal), squared = length2(normal);
    if (area == 0 || !(squared > 0)) return 0;
    const Vec2 at = moved(photon, normal, wi, area, squared);
    if (std::abs(photon.uv.x - at.x) > reach_.x || std::abs(photon.uv.y - at.y) > reach_.y) return 0;
    return 1 / (std::abs(area) * within(at.x, reach_.x) * within(at.y, reach_.y));
  }

 private:
  static float reach(float radius, const Vec3& derivative) {
    const float speed = length(derivative);
    return speed > 0 ? radius / speed : 1;
  }
  static float within(float x, float reach) { return std::min(x + reach, 1.f) - std::max(x - reach, 0.f); }
  /// Limits the shift: a beam that grazes the strip would move points far along it, to where it bends.
  float most_shift() const { return length(seen_.across) / std::max(length(seen_.along), 1e-30f); }

  /// Returns the point that is seen, moved along the beam onto the strip that the beam sees.
  Vec2 moved(const StripPlace& photon, const Vec3& normal, const Vec3& wi, float area, float squared) const {
    const Vec3 own = seen_.across * (seen_.uv.y - 0.5f), off = own - wi * (dot(own, normal) / area);
    const float u = dot(cross(off, photon.across), normal) / squared, most = most_shift();
    const float v = dot(cross(photon.along, off), normal) / squared;
    return {std::clamp(seen_.uv.x + std::clamp(u, -most, most), 0.f, 1.f), std::clamp(0.5f + v, 0.f, 1.f)};
  }

  const StripPlace& seen_;
  Vec2 reach_;
};

}  // namespace dspm
