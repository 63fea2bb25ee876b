// Sphere, cylinder and disk share this: where a ray meets a circle's or a sphere's surface, and the angle that the
// shape covers around the z axis. Intersections are in double, because rays come from far away and leave from very
// near.
#pragma once

#include <algorithm>
#include <optional>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/elementary.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

/// The line o + t d meets the surface at t[0] <= t[1].
struct Roots {
  double t[2];
};

/// Solves |o + t d| = r. A cylinder passes vectors with z = 0. The discriminant is computed from the line's distance to
/// the centre, because |o|^2 - r^2 has no digits left if the sphere is far away. [Haines et al. 2019, Ray Tracing Gems,
/// ch. 7]
constexpr std::optional<Roots> meet_round(const DoubleVec3& o, const DoubleVec3& d, double r) {
  const double a = dot(d, d), b = dot(o, d);
  if (!(a > 0)) return std::nullopt;
  const double distance = length(o + d * (-b / a));
  const double discriminant = a * (r + distance) * (r - distance);
  if (!(discriminant >= 0)) return std::nullopt;
  const double q = -(b + elementary::copysign(elementary::sqrt(discriminant), b)),
               c = (length(o) + r) * (length(o) - r);
  const double t0 = q / a, t1 = q == 0 ? t0 : c / q;
  return t0 < t1 ? Roots{{t0, t1}} : Roots{{t1, t0}};
}

/// Replaces the 0 at a pole, where u has no direction, so that dpdu keeps one.
inline constexpr double kLeastSine = 1e-6;
/// Returns the larger number. std::max takes references, which a GPU cannot take of constants.
constexpr double at_least(double x, double least) { return x < least ? least : x; }

/// The angles around z from 0 to phimax; a point's u is its fraction of phimax.
class Sweep {
 public:
  /// Takes any number: those that are not between 0 and 360 are a whole turn.
  constexpr explicit Sweep(float degrees)
      : full_(!(degrees > 0 && degrees < 360)),
        phi_max_(full_ ? 2 * elementary::kPi : degrees * (elementary::kPi / 180)) {}

  constexpr double phi_max() const { return phi_max_; }  // radians
  constexpr bool is_whole() const { return full_; }
  constexpr double phi(float u) const { return u * phi_max_; }
  /// Returns nullopt where the shape is cut away.
  constexpr std::optional<float> u_of(double x, double y) const {
    double phi = elementary::atan2(y, x);
    if (phi < 0) phi += 2 * elementary::kPi;
    const double u = phi / phi_max_;
    if (!full_ && u > 1) return std::nullopt;
    return static_cast<float>(std::min(u, 1.0));
  }

 private:
  bool full_;
  double phi_max_;
};

/// Returns the nearer root in (0, t_max) for which `at(t)` gives the parameters of a point of the shape.
template <class At>
constexpr std::optional<PrimitiveHit> first_hit(const Roots& roots, float t_max, const At& at) {
  for (const double root : roots.t) {
    const auto t = static_cast<float>(root);
    if (!(t > 0 && t < t_max && t < kInfinity)) continue;
    if (const std::optional<Vec2> uv = at(root)) return PrimitiveHit{t, *uv};
  }
  return std::nullopt;
}

}  // namespace dspm
