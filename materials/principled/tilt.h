// A lobe whose normal leans, in the shading frame of the others: a coat with a relief of its own, or a mirror whose
// reflection would go below the surface.
#pragma once

#include <algorithm>
#include <cmath>

#include "dspm/base/math/vec.h"
#include "dspm/materials/bsdf.h"
#include "dspm/materials/fresnel.h"

namespace dspm {

class Tilt {
 public:
  /// Tilts nothing: the lobe sees the directions themselves.
  Tilt() = default;
  /// Tilts the lobe to the unit normal n.
  explicit Tilt(const Vec3& n) : none_(n == Vec3{0, 0, 1}), basis_(none_ ? Basis{} : Basis::around(n, {1, 0, 0})) {}

  bool none() const { return none_; }
  Vec3 seen(const Vec3& w) const { return none_ ? w : basis_.to_local(w); }
  Vec3 back(const Vec3& w) const { return none_ ? w : basis_.to_world(w); }
  float cosine(const Vec3& w) const { return none_ ? w.z : dot(w, basis_.z); }

  /// Both directions as the lobe sees them, with the facet that mirrors one into the other.
  struct Pair {
    Vec3 o, i, m;
    float factor;  // times the lobe's f: light arrives at its surface by another cosine than ours
    bool above;
  };
  Pair pair(const Vec3& o, const Vec3& i, Transport transport) const {
    const Vec3 seen_o = seen(o), seen_i = seen(i);
    const Vec3 m = normalize(seen_o + seen_i);
    const float factor = none_ ? 1 : transport == Transport::radiance ? seen_i.z / i.z : seen_o.z / o.z;
    return {seen_o, seen_i, m, factor, seen_o.z > 0 && seen_i.z > 0};
  }
  /// Returns the factor to the weight of the one direction that a smooth lobe mirrors: 1 for radiance.
  float mirror_factor(const Vec3& o, const Vec3& i, Transport transport) const {
    return none_ || transport == Transport::radiance ? 1 : i.z / o.z;
  }

 private:
  bool none_ = true;
  Basis basis_{};
};

/// Returns the normal n of a mirror on a surface with normal `ng`, all on o's side. It is bent, if need be, so that
/// what it mirrors of o leaves the surface: the mirrored direction is lifted to just above the horizon, and the normal
/// is halfway between it and o.
inline Vec3 lifted(const Vec3& n, const Vec3& o, const Vec3& ng) {
  constexpr float kAbove = 0.01f;
  const Vec3 mirrored = reflect(o, n);
  const float up = dot(mirrored, ng), least = 0.5f * std::min(kAbove, dot(o, ng));
  if (up >= least || dot(o, n) <= 0) return n;
  const Vec3 along = mirrored - ng * up;
  const Vec3 bent = normalize(o + along * (std::sqrt(1 - least * least) / length(along)) + ng * least);
  return is_finite(bent) ? bent : n;
}

}  // namespace dspm
