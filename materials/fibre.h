// Scatters light at a dielectric fibre with scales, in a plane along it and across it. Directions are given by theta
// from the plane across the fibre, and phi around it. Path p of light is reflected (0), goes through (1), or is
// reflected once inside (2); kFibrePaths counts those, the others are taken together. [Chiang, Bitterli, Tappan, Burley
// 2016, A Practical and Controllable Hair and Fur Model for Production Path Tracing; d'Eon et al. 2011, An
// Energy-Conserving Hair Reflectance Model]
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/fresnel.h"

namespace dspm {

inline constexpr int kFibrePaths = 3;
template <class T>
using ByFibrePath = std::array<T, kFibrePaths + 1>;

inline float cos_of(float sin) { return std::sqrt(std::max(0.f, 1 - sin * sin)); }

/// Returns the logarithm of the modified Bessel function of the first kind and order 0, x >= 0. [Abramowitz and Stegun,
/// 9.8.1, 9.8.2]
inline float log_bessel_i0(float x) {
  constexpr float kBorder = 3.75f;
  if (x < kBorder) {
    const float t = x * x / (kBorder * kBorder);
    return rounded::log(
        1 +
        t * (3.5156229f + t * (3.0899424f + t * (1.2067492f + t * (0.2659732f + t * (0.0360768f + t * 0.0045813f))))));
  }
  const float t = kBorder / x;
  const float series =
      0.39894228f +
      t * (0.01328592f +
           t * (0.00225319f +
                t * (-0.00157565f +
                     t * (0.00916281f +
                          t * (-0.02057706f + t * (0.02635537f + t * (-0.01647633f + t * 0.00392377f)))))));
  return x + rounded::log(series / std::sqrt(x));
}

/// Scattering along the fibre with variance v: a density over directions by cos(theta) dtheta that tends to
/// -theta_o.
class Longitudinal {
 public:
  explicit Longitudinal(float v)
      : v_(v), log_scale_(-rounded::log(v) - 1 / v - rounded::log1p(-rounded::exp(-2 / v))) {}

  /// Returns 1 / (2 v sinh(1 / v)) e^(-sin sin / v) I0(cos cos / v), where 2 sinh(x) = e^x (1 - e^-2x).
  float density(float sin_o, float cos_o, float sin_i, float cos_i) const {
    return rounded::exp(log_bessel_i0(cos_o * cos_i / v_) - sin_o * sin_i / v_ + log_scale_);
  }
  /// Returns sin(theta_i).
  float sample(float sin_o, float cos_o, Vec2 u) const {
    const float cos = std::max(-1.f, 1 + v_ * rounded::log(u.x + (1 - u.x) * rounded::exp(-2 / v_)));
    return std::clamp(-cos * sin_o + cos_of(cos) * rounded::cos(2 * kPi * u.y) * cos_o, -1.f, 1.f);
  }

 private:
  float v_, log_scale_;
};

/// Scattering around the fibre: a logistic distribution of scale s, cut off at +-pi.
class Azimuthal {
 public:
  explicit Azimuthal(float s) : s_(s), low_(cumulative(-kPi)), span_(cumulative(kPi) - low_) {}

  /// Returns the density at an angle from the middle of the distribution.
  float density(float angle) const {
    angle -= 2 * kPi * std::floor((angle + kPi) / (2 * kPi));
    const float e = rounded::exp(-std::abs(angle) / s_);
    return e / (s_ * (1 + e) * (1 + e) * span_);
  }
  float sample(float u) const {
    const float x = -s_ * rounded::log(1 / (u * span_ + low_) - 1);
    return std::clamp(x, -kPi, kPi);
  }

 private:
  float cumulative(float x) const { return 1 / (1 + rounded::exp(-x / s_)); }
  float s_, low_, span_;
};

/// The effect of a fibre's cross section on a ray that meets it at h (from -1 to 1 across it).
struct FibrePassage {
  float gamma_o, gamma_t;  // the angles to the normal, outside and inside
  ByFibrePath<Spectrum> attenuation;

  FibrePassage(float sin_o, float cos_o, float h, float eta, const Spectrum& sigma_a) {
    const float sin_t = sin_o / eta, bravais = std::sqrt(std::max(0.f, eta * eta - sin_o * sin_o)) / cos_o;
    // An index below 1 may reflect all: then there is no way inside.
    const float sin_gamma_t = bravais > 0 ? std::clamp(h / bravais, -1.f, 1.f) : 0, cos_t = cos_of(sin_t);
    gamma_o = rounded::asin(std::clamp(h, -1.f, 1.f)), gamma_t = rounded::asin(sin_gamma_t);
    const float way = cos_t > 0 ? 2 * cos_of(sin_gamma_t) / cos_t : 0;
    const Spectrum passed = map(sigma_a, [way](float sigma) { return rounded::exp(-sigma * way); });
    const float mirrored = fresnel_dielectric(cos_o * cos_of(h), eta);
    attenuation[0] = Spectrum(mirrored);
    attenuation[1] = (1 - mirrored) * (1 - mirrored) * passed;
    attenuation[2] = attenuation[1] * passed * mirrored;
    for (int c = 0; c < 3; ++c)  // the remaining geometric series
      attenuation[3][c] = mirrored < 1 ? attenuation[2][c] * mirrored * passed[c] / (1 - mirrored * passed[c]) : 0;
  }

  /// Returns the azimuth in which path p leaves, relative to that of the ray.
  float turn(int p) const {
    const auto n = static_cast<float>(p);
    return 2 * n * gamma_t - 2 * gamma_o + n * kPi;
  }
};

}  // namespace dspm
