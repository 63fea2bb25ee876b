// How radii shrink: a pixel's statistics of all photons so far, in one frame, and how an iteration updates them; and
// the radius that depends on the iteration alone.
#pragma once

#include <cmath>
#include <cstdint>

#include "dspm/base/colour/rgb.h"
#include "dspm/integrators/photons/hit_point.h"

namespace dspm {

/// The sums that one hit point gathers in one iteration; discarded after it.
struct PassSums {
  std::uint32_t M = 0;  // photons within the search radius, on the front of the surface
  Rgb phi;              // their flux times f and the camera path's throughput

  PassSums& operator+=(const PassSums& o) {
    M += o.M, phi += o.phi;
    return *this;
  }
};

/// The statistics that are kept across iterations. [HJ09, WG12 (1)-(5)]
struct PixelStatistics {
  double N = 0;  // photons accepted; a fraction alpha of those found
  float R2 = 0;  // search radius squared; 0: no hit point yet
  Rgb tau;       // flux within the search radius, weighted like phi; as if within a radius of 1 while there is none

  /// Sets the radius of the first hit point.
  void begin(float radius2) {
    if (R2 == 0) R2 = radius2, tau = tau * radius2;
  }

  /// Adds light that needs no photons, as the flux that yields its radiance; shrinking the disc preserves that.
  /// `emitted` is the number of paths in this iteration.
  void see(const Rgb& radiance, float emitted) { tau += radiance * (emitted * kernel()); }

  /// Accepts a fraction alpha of the M new photons and shrinks the disc so that the density stays the same.
  /// [WG12 (1), (2), (4)]
  void absorb(const PassSums& sums, float alpha) {
    if (sums.M == 0) return;
    const double M = sums.M, accepted = N + static_cast<double>(alpha) * M;
    const auto shrink = static_cast<float>(accepted / (N + M));  // (R'/R)^2
    tau = (tau + sums.phi) * shrink;
    R2 *= shrink;
    N = accepted;
  }

  /// The radiance after `emitted` paths. [WG12 (5)]
  Rgb radiance(double emitted) const {
    return emitted == 0 ? Rgb() : tau * static_cast<float>(1 / (emitted * static_cast<double>(kernel())));
  }

 private:
  float kernel() const { return kernel_size(R2 == 0 ? 1 : R2); }
};

/// kz11's radius, the same for all pixels and frames except for its initial value: a function of the iteration.
class IterationRadius {
 public:
  float of(float initial) const { return initial * static_cast<float>(scale_); }
  float squared(float initial) const {
    const float radius = of(initial);
    return radius * radius;
  }
  /// Goes to the radius of an iteration, counted from 0. After the i-th, counted from 1: s'^2 = s^2 (i + alpha) / (i +
  /// 1). [KZ11]
  void go_to(int iteration, float alpha) {
    if (iteration < iteration_) *this = {};
    while (iteration_ < iteration) {
      const auto i = static_cast<double>(++iteration_);
      scale_ *= std::sqrt((i + static_cast<double>(alpha)) / (i + 1));
    }
  }

 private:
  int iteration_ = 0;
  double scale_ = 1;
};

}  // namespace dspm
