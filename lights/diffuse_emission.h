// The directions in which a point of a diffuse surface emits: by their cosine to its geometric normal, on that side of the
// surface or on both.
#pragma once

#include <cmath>

#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"

namespace dspm {

struct DiffuseEmission {
  bool two_sided = false;

  constexpr float sides() const { return two_sided ? 2.f : 1.f; }
  /// Returns whether light leaves in directions of that cosine to the normal.
  constexpr bool shines(float cosine) const { return cosine > 0 || (two_sided && cosine < 0); }

  constexpr Vec3 sample(const Vec3& normal, Vec2 u) const {
    float side = 1;
    if (two_sided) {
      side = u.x < 0.5f ? 1.f : -1.f;
      u.x = 2 * u.x - (side < 0 ? 1.f : 0.f);
    }
    return normalize(Basis::around(side * normal).to_world(cosine_hemisphere(u)));
  }
  constexpr float pdf_w(float cosine) const {
    return cosine_hemisphere_pdf_w(two_sided ? std::abs(cosine) : cosine) / sides();
  }
  /// Returns the u with sample(normal, u) = w.
  constexpr Vec2 numbers(const Vec3& normal, const Vec3& w) const {
    const float side = two_sided && dot(normal, w) < 0 ? -1.f : 1.f;
    const Vec3 local = Basis::around(side * normal).to_local(w);
    Vec2 u = concentric_disk_numbers({local.x, local.y});
    if (two_sided) u.x = 0.5f * (u.x + (side < 0 ? 1.f : 0.f));
    return u;
  }
};

}  // namespace dspm
