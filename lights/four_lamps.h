// What four lamps, or groups of lamps, may send to a point, side by side: the bounds of their light in four SIMD lanes.
// [Conty Estevez and Kulla 2018; Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.6.3]
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/simd.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/light_bounds.h"

namespace dspm {

/// A point that gets light. The normal, which may point to either side, is zero if it is not known.
struct LightReceiver {
  Vec3 p, n = {};
};

/// A receiver in four equal lanes.
struct FourReceivers {
  __m128 p[3], n[3];
  bool has_normal;

  explicit FourReceivers(const LightReceiver& at) : has_normal(!(at.n == Vec3{})) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = _mm_set1_ps(at.p[axis]), n[axis] = _mm_set1_ps(at.n[axis]);
  }
};

class FourLamps {
 public:
  /// The intensity is that along their normals, of all the lane's lamps together, and more than 0.
  void set(std::size_t lane, const LightBounds& bounds, double intensity) {
    const Vec3 center = bounds.box.center();
    for (int axis = 0; axis < 3; ++axis) center_[axis][lane] = center[axis], axis_[axis][lane] = bounds.axis[axis];
    radius2_[lane] = 0.25f * length2(bounds.box.extent());
    cos_spread_[lane] = rounded::cos(bounds.spread), sin_spread_[lane] = std::max(0.f, rounded::sin(bounds.spread));
    cos_reach_[lane] = rounded::cos(bounds.reach);
    intensity_[lane] = static_cast<float>(std::clamp(intensity, double{FLT_MIN}, double{FLT_MAX}));
    one_sided_[lane] = bounds.two_sided ? 0.f : -0.f;
  }

  /// Returns intensities at the receiver but for a common factor: finite, 0 for lanes that are not set, and more for the
  /// others.
  __m128 importance(const FourReceivers& at) const;

 private:
  // Lets rounding, and lamps that are not quite where their bounds say, do no harm.
  static constexpr float kLeastCosine = 1e-4f;

  /// An angle of [0, pi].
  struct Angles {
    __m128 sin, cos;
    /// The difference, which stops at 0.
    Angles less(const Angles& by) const {
      const __m128 none = _mm_cmpgt_ps(cos, by.cos);
      return {_mm_andnot_ps(none, sin * by.cos - cos * by.sin), cos_less(by)};
    }
    __m128 cos_less(const Angles& by) const {
      return _mm_blendv_ps(cos * by.cos + sin * by.sin, _mm_set1_ps(1), _mm_cmpgt_ps(cos, by.cos));
    }
  };
  static Angles of_cosine(__m128 c) { return {_mm_sqrt_ps(_mm_max_ps(_mm_set1_ps(1) - c * c, _mm_setzero_ps())), c}; }
  static __m128 dot(const __m128* a, const __m128* b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

  alignas(16) float center_[3][4] = {};
  alignas(16) float radius2_[4] = {};  // of the sphere around the box
  alignas(16) float axis_[3][4] = {};
  alignas(16) float cos_spread_[4] = {}, sin_spread_[4] = {}, cos_reach_[4] = {};
  alignas(16) float intensity_[4] = {};
  alignas(16) float one_sided_[4] = {};  // -0: the sign of the cosine to the axis matters
};

// The cosine to the nearest normal of the cone, for the direction of the box's sphere that is best for it, over the
// squared distance. Within the sphere it may be any direction. Operands that may be NaN come first in min and max, which
// then return the other.
inline __m128 FourLamps::importance(const FourReceivers& at) const {
  const __m128 one = _mm_set1_ps(1), sign = _mm_set1_ps(-0.f), least = _mm_set1_ps(kLeastCosine);
  __m128 d[3], axis[3];
  for (int i = 0; i < 3; ++i) d[i] = at.p[i] - _mm_load_ps(center_[i]), axis[i] = _mm_load_ps(axis_[i]);
  const __m128 d2 = dot(d, d), radius2 = _mm_load_ps(radius2_), intensity = _mm_load_ps(intensity_);
  const __m128 per_d2 = one / _mm_max_ps(_mm_max_ps(d2, radius2), _mm_set1_ps(1e-30f)), per_d = _mm_sqrt_ps(per_d2);
  const __m128 sin2_box = _mm_min_ps(radius2 * per_d2, one);
  const Angles box{_mm_sqrt_ps(sin2_box), _mm_sqrt_ps(one - sin2_box)},
      spread{_mm_load_ps(sin_spread_), _mm_load_ps(cos_spread_)};
  const __m128 cosine = dot(axis, d) * per_d,
               to_axis = _mm_or_ps(_mm_andnot_ps(sign, cosine), _mm_and_ps(cosine, _mm_load_ps(one_sided_)));
  const __m128 to_normal = of_cosine(to_axis).less(spread).cos_less(box);
  __m128 factor = _mm_max_ps(_mm_and_ps(to_normal, _mm_cmpgt_ps(to_normal, _mm_load_ps(cos_reach_))), least);
  if (at.has_normal) {
    const Angles facing = of_cosine(_mm_andnot_ps(sign, dot(at.n, d) * per_d));
    factor = factor * _mm_max_ps(facing.cos_less(box), least);
  }
  factor = _mm_blendv_ps(one, factor, _mm_cmpgt_ps(d2, radius2));
  const __m128 sent = _mm_min_ps(intensity * factor * per_d2, _mm_set1_ps(1e38f));
  return _mm_max_ps(sent, _mm_min_ps(intensity, _mm_set1_ps(FLT_MIN)));
}

}  // namespace dspm
