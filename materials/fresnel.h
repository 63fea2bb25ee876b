// The reflectance of a smooth interface, and the directions of its light. Angles are given by cosines against the
// interface's normal on the side of the arriving light; `eta` is the index of refraction beyond over the index on this
// side.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// The unpolarised reflectance of a dielectric; 1 at total reflection. cos_i in [0, 1].
constexpr float fresnel_dielectric(float cos_i, float eta) {
  const float sin2_t = (1 - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1) return 1;
  const float cos_t = rounded::sqrt(1 - sin2_t);
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// The unpolarised reflectance of a conductor whose index of refraction is eta + ik. The complex cosine beyond the
/// interface is (a + ib) / (eta + ik) with a^2 + b^2 = `ab`. [Born and Wolf, Principles of Optics, 14.2]
constexpr float fresnel_conductor(float cos_i, float eta, float k) {
  const float c2 = cos_i * cos_i, s2 = 1 - c2;
  const float difference = eta * eta - k * k - s2, product = 2 * eta * k;
  const float ab = rounded::sqrt(difference * difference + product * product);
  // The second form is the same number, without cancellation if k is large.
  const float a2 = difference >= 0 ? 0.5f * (ab + difference) : 0.5f * product * product / (ab - difference);
  const float t = 2 * cos_i * rounded::sqrt(a2), t_s2 = t * s2, square = c2 * ab + s2 * s2;
  const float perpendicular = (ab + c2 - t) / (ab + c2 + t);
  const float parallel = perpendicular * (square - t_s2) / (square + t_s2);
  const float reflected = 0.5f * (perpendicular + parallel);
  return reflected < 0 ? 0 : reflected;  // by rounding, if nothing is reflected
}
constexpr Spectrum fresnel_conductor(float cos_i, const Spectrum& eta, const Spectrum& k) {
  return {fresnel_conductor(cos_i, eta[0], k[0]), fresnel_conductor(cos_i, eta[1], k[1]),
          fresnel_conductor(cos_i, eta[2], k[2])};
}

/// Close to the reflectance of diffuse light: taken at the cosine at which Schlick's term is its mean.
constexpr Spectrum mean_fresnel_conductor(const Spectrum& eta, const Spectrum& k) {
  return fresnel_conductor(0.456f, eta, k);
}

/// Close to the reflectance of a conductor that mirrors `straight` straight on. [Schlick 1994]
constexpr Spectrum fresnel_schlick(const Spectrum& straight, float cos) {
  const float c = 1 - cos, c2 = c * c;
  return straight + (Spectrum(1) - straight) * (c2 * c2 * c);
}

constexpr Vec3 reflect(const Vec3& w, const Vec3& n) { return n * (2 * dot(w, n)) - w; }

/// The direction beyond the interface, of unit length; nullopt at total reflection. dot(w, n) >= 0.
constexpr std::optional<Vec3> refract(const Vec3& w, const Vec3& n, float eta) {
  const float cos_i = dot(w, n), sin2_t = std::max(0.f, 1 - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1) return std::nullopt;
  return n * (cos_i / eta - rounded::sqrt(1 - sin2_t)) - w / eta;
}

/// The fraction of diffuse light from outside that a dielectric reflects: 2 * integral of F(c) c dc.
constexpr float mean_fresnel_outside(float eta) {
  constexpr int kSteps = 4096;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double c = (i + 0.5) / kSteps;
    sum += static_cast<double>(fresnel_dielectric(static_cast<float>(c), eta)) * c;
  }
  return static_cast<float>(2 * sum / kSteps);
}

}  // namespace dspm
