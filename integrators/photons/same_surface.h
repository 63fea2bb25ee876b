// Which photons belong to the surface of a hit point: by the side that they have come to, and by how near they are to its plane.
#pragma once

#include <cmath>

#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/shape_face.h"

namespace dspm {

/// Counts photons of both sides of a surface that transmits, but not those of another surface close by, such as the
/// other side of a thin slab or the next of two sheets: they must have come to the same side, as its outward normal
/// tells the two apart, of the same shape or of one that goes on in the same plane.
class SameSurface {
 public:
  /// `ng` is on the side of `face`, `p_error` is the error of p, and photons are sought within `radius`.
  constexpr SameSurface(const Vec3& p, const Vec3& ng, const Vec3& p_error, ShapeFace face, float radius)
      : p_(p), ng_(ng), face_(face), rounding_(2 * dot(abs(ng), p_error)), flat_(kFlat * radius + rounding_) {}

  /// Returns whether a photon at p that has come to `face` from wi counts.
  constexpr bool counts(const Vec3& p, const Vec3& wi, ShapeFace face) const {
    const float off = std::abs(dot(p - p_, ng_));
    if (off <= rounding_) return true;  // whichever way the parts of a plane are wound
    const bool from_here = dot(wi, ng_) > 0, same_face = face.is_inner() == face_.is_inner();
    return from_here == same_face && (face.shape() == face_.shape() || off <= flat_);
  }

 private:
  static constexpr float kFlat = 1e-3f;  // of the radius: how far apart the shapes of one plane may be

  Vec3 p_, ng_;
  ShapeFace face_;
  float rounding_, flat_;
};

}  // namespace dspm
