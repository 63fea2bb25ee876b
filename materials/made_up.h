// A diffuse lobe for light that meets a second facet, which single facets lose. With E the directional albedo of white
// facets, f = (1 - E(o)) (1 - E(i)) / (pi (1 - mean E)) gives back all that they lose. [Kulla and Conty 2017]
#pragma once

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/albedo_table.h"
#include "dspm/materials/brushed_albedo.h"

namespace dspm {

/// E of facets of one or two roughnesses, from tables that outlive it.
class FacetAlbedo {
 public:
  /// `brushed` holds facets of two roughnesses; it may be null if both are equal.
  constexpr FacetAlbedo(Vec2 alpha, const AlbedoTable& even, const BrushedAlbedo* brushed)
      : alpha_{std::max(alpha.x, alpha.y), std::min(alpha.x, alpha.y)},
        is_turned_(alpha.y > alpha.x),
        even_(even),
        brushed_(alpha.x == alpha.y ? nullptr : brushed) {}

  /// Returns 1 - smoother alpha / rougher alpha: 0 if both are equal.
  constexpr float narrowness() const { return brushed_ ? 1 - alpha_.y / alpha_.x : 0; }

  constexpr float of(float cos, float turn) const {
    return brushed_ ? brushed_->of(cos, turn, alpha_) : even_.of(cos, mean_alpha());
  }
  /// Returns E for w, which may lie below.
  constexpr float of(const Vec3& w) const {
    return of(std::abs(w.z), brushed_ ? BrushedAlbedo::turn(is_turned_ ? Vec3{w.y, w.x, w.z} : w, alpha_) : 0);
  }
  constexpr float mean() const { return brushed_ ? brushed_->mean(alpha_) : even_.mean(mean_alpha()); }

 private:
  constexpr float mean_alpha() const { return (alpha_.x + alpha_.y) / 2; }

  Vec2 alpha_;  // x is the greater
  bool is_turned_;
  const AlbedoTable& even_;
  const BrushedAlbedo* brushed_;
};

// Tables of brushed facets know what is lost to so much: they make up for less, to gain nothing.
inline constexpr float kUnsureIfBrushed = 0.02f, kUnsureInsideIfBrushed = 0.1f;

/// Returns f for what two directions and diffuse light lose.
constexpr float made_up(float lost_o, float lost_i, float mean_lost) {
  return mean_lost < 1e-5f ? 0 : std::max(0.f, lost_o) * std::max(0.f, lost_i) / (kPi * mean_lost);
}

/// Returns what leaves metal facets after two or more reflections, as a factor to white metal's share. [Kulla and Conty
/// 2017; Hill 2018]
constexpr Spectrum after_more_reflections(const Spectrum& mean_fresnel, float mean_albedo) {
  Spectrum left;
  for (int c = 0; c < 3; ++c)
    left[c] = mean_fresnel[c] * mean_fresnel[c] * mean_albedo / (1 - mean_fresnel[c] * (1 - mean_albedo));
  return left;
}

}  // namespace dspm
