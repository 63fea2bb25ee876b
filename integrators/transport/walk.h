// A random walk through a body that scatters: straight flights between collisions, each with a new direction by Henyey
// and Greenstein, or diffuse where the surface throws light back. Its flights are drawn for one colour, chosen where
// the walk begins at the surface; a colour's weight is its own density over the mean of all three, at most 3, which
// does not depend on frames. [Wilkie et al. 2014, Hero Wavelength Spectral Sampling]
#pragma once

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/interior.h"
#include "dspm/shapes/shape.h"

namespace dspm {

class Walk {
 public:
  Walk() = default;
  explicit Walk(const Interior& interior) : interior_(interior) {}

  bool is_inside() const { return !interior_.is_empty(); }
  /// Begins at the surface: the ray ends where the first flight does. Leaves rays outside as they are.
  void start(Ray& ray, const PathRandom& random, int bounce);
  /// Returns the factor to what the path carries when the ray has met the surface at `distance`.
  Spectrum reach(float distance);
  /// Returns whether the surface throws light back there, along the normal `inward`; if so, the ray becomes the next
  /// flight's.
  bool is_thrown_back(Ray& ray, const SurfacePoint& point, const Vec3& inward, const PathRandom& random, int bounce);
  /// Returns the factor at the end of the ray, which becomes the next flight's. It is black if light is absorbed.
  Spectrum scatter(Ray& ray, const PathRandom& random, int bounce);

 private:
  void fly(Ray& ray, const PathRandom& random, int bounce) const;
  /// Weights the colours by their densities of what has been drawn.
  Spectrum weigh(const Spectrum& density);

  Interior interior_;
  Spectrum share_{1};   // of each colour's density, over the mean
  Spectrum weight_{1};  // of this walk, after roulette
  int hero_ = 0;        // the colour whose flights are drawn
  int collisions_ = 0;
};

}  // namespace dspm
