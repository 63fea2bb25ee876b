// Where the light of a lamp, or of several, leaves from, and which way it goes: enough to tell which of many lamps may
// matter at a point. [Conty Estevez and Kulla 2018, Importance Sampling of Many Lights with Adaptive Tree Splitting;
// Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.6.3]
#pragma once

#include "dspm/base/math/vec.h"

namespace dspm {

/// Light leaves points of the box along the normals of a cone, and weaker with the cosine to them.
struct LightBounds {
  Bounds3 box;
  Vec3 axis{0, 0, 1};      // of the cone, unit length
  float spread = kPi;      // the angle between the axis and the outermost normals
  float reach = kPi / 2;   // no light leaves at a larger angle to all normals
  bool two_sided = false;  // along the opposite normals, too

  /// Extends them to include another's.
  void add(const LightBounds& other);
  /// Returns the integral, over all directions, of the cosine to the nearest normal. [Conty Estevez and Kulla 2018, 4.1]
  double solid_angle() const;
};

}  // namespace dspm
