// A band of a picture around the sphere, between two rows of nodes: how much of the sphere lies where in it. Places in
// it go from t = 0 at the upper row to 1 at the lower one.
#pragma once

#include "dspm/base/math/sphere_mapping.h"

namespace dspm {

class SphereBand {
 public:
  /// Takes the band between two places down the picture, 0 <= top < bottom <= 1.
  SphereBand(SphereMapping mapping, double top, double bottom);

  /// The solid angle per unit of the place across, with directions weighted by 1 - t; lower() weights them by t.
  float upper() const { return upper_; }
  float lower() const { return lower_; }
  /// Draws t in proportion to solid angle times what is linear between a and b, neither below 0, from a uniform number.
  float sample(float u, float a, float b) const;
  /// Returns the u with sample(u, a, b) = t.
  float number(float t, float a, float b) const;

 private:
  /// The integral from 0 to t of solid angle times what is linear between a and b.
  double to(double t, double a, double b) const;
  double angle(double t) const { return top_ + height_ * t; }

  SphereMapping mapping_;
  double top_, height_;  // of places, or of polar angles
  float upper_, lower_;
};

}  // namespace dspm
