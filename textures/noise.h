// Perlin's noise, and sums of its octaves: what the textures fbm, wrinkled, windy, marble and dots are made of.
// [Perlin 2002, Improving Noise; Perlin 1985, An Image Synthesizer]
#pragma once

#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"

namespace dspm {

/// Returns noise that is smooth, 0 at all points with whole coordinates, in (-1, 1), and the same in dspm and pbrt. It
/// is 0 if p is not finite.
float noise(const Vec3& p);

/// The parameters of a sum of octaves: each is 1.99 times as fine as the last, and has `roughness` times its strength.
struct Octaves {
  int count = 8;
  float roughness = 0.5f;

  /// Reads "octaves" and "roughness". Wrong values are errors, and their defaults apply.
  static Octaves read(ParamReader& reader);
};

/// Sums over `octaves`. [Musgrave 1992; Pharr, Jakob, Humphreys, Physically Based Rendering, 3rd edition, 10.6.4]
float fbm(const Vec3& p, const Octaves& octaves);
/// Sums |noise| over `octaves`.
float turbulence(const Vec3& p, const Octaves& octaves);

}  // namespace dspm
