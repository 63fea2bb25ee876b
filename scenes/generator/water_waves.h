// Waves on the water of a square basin: gravity and surface tension over a flat floor, linear, reflected by the walls.
// Every standing wave of the basin swings on its own, so the state at any time is a sum that needs no time steps.
//   height(x, z, t) = sum over m, n of a_mn(t) cos(m pi x / side) cos(n pi z / side),   k = pi / side |(m, n)|
//   a_mn(t) = strength exp(-damping k^2 t) sin(omega t) / omega after a blow,
//   omega^2 = (g k + sigma / rho k^3) tanh(k depth)
// [Lamb, Hydrodynamics, 6th ed., 228, 231, 266]
#pragma once

#include <vector>

#include "dspm/base/math/vec.h"

namespace dspm {

/// Something hits the water: at once its surface moves down there and up around, as v (1 - r^2 / R^2) exp(-r^2 / R^2).
struct Blow {
  float time;      // s
  Vec2 place;      // m, from the basin's corner
  float radius;    // m, R
  float velocity;  // m/s, v; downwards
};

class WaterWaves {
 public:
  /// `side` and `depth` in metres, `damping` in m^2/s: twice water's viscosity, or more to calm the waves.
  WaterWaves(float side, float depth, float damping, std::vector<Blow> blows);

  struct Point {
    float height;
    Vec2 slope;
  };
  /// At all pairs of the coordinates, x running fastest.
  std::vector<Point> surface(const std::vector<float>& xs, const std::vector<float>& zs, float time) const;

 private:
  std::vector<double> amplitudes(float time) const;

  double side_, depth_, damping_;
  std::vector<Blow> blows_;
};

}  // namespace dspm
