// Points of a segment near a light: drawn by the angle under which the light sees them, so that they are dense where its light is
// strong. [Kulla and Fajardo 2012, Importance Sampling Techniques for Path Tracing in Participating Media, 4.1]
#pragma once

#include "dspm/base/math/ray.h"
#include "dspm/lights/light_bounds.h"

namespace dspm {

class NearLight {
 public:
  /// Of a spot, only the part of the segment that its cone may light has points.
  NearLight(const Ray& ray, float begin, float end, const LightBounds& light);

  bool is_empty() const { return !(last_ > first_); }
  float draw(float u) const;
  /// Returns the density by length with which draw() draws a point.
  float density(float t) const;

 private:
  float begin_, end_;
  float closest_, distance_;    // of the point that is closest to the light, and to it
  float first_ = 0, last_ = 0;  // angles from there, as the light sees them
};

}  // namespace dspm
