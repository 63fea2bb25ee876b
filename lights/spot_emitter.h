// How a point shines into a cone, with a falloff towards its edge. Angles are given by their versine, 1 - cos, which has
// digits left where the cosine has none, and in which solid angles are even.
#pragma once

#include <algorithm>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/emission.h"

namespace dspm {

struct SpotEmitter {
  Vec3 p;
  Basis basis;  // around the axis
  Rgb intensity;
  float inner, outer;  // versines: where the falloff begins, and where it ends

  // The falloff has half the solid angle of its ring.
  constexpr Rgb power() const { return kPi * (inner + outer) * intensity; }

  constexpr Emission emit(Vec2, Vec2 u) const {
    const float share = share_of_inner();
    const float versine =
        u.x < share ? inner * (u.x / share) : outer - (outer - inner) * sample_falloff((u.x - share) / (1 - share));
    const Vec3 w = normalize(basis.to_world(direction_at_height(1 - versine, versine * (2 - versine), u.y)));
    const Ray ray{p, w};
    return {ray, power(), pdf_emit(ray)};
  }

  constexpr EmissionPdf pdf_emit(const Ray& start) const {
    return {1, falloff(start.direction) / (kPi * (inner + outer)), true, false};
  }

  constexpr EmissionNumbers emission_numbers(const Ray& start) const {
    const float versine = versine_of(start.direction), share = share_of_inner();
    const float x = (outer - versine) / (outer - inner);
    const float place =
        versine < inner || inner == outer ? share * (versine / inner) : share + (1 - share) * (x * x * x * (2 - x));
    return {kAnyNumber, kAnyNumber, std::clamp(place, 0.f, 1.f), turn_of(basis.to_local(start.direction))};
  }

  constexpr std::optional<Illumination> illuminate(const Vec3& from) const {
    const Vec3 d = p - from;
    const float distance = length(d);
    if (!(distance > 0)) return std::nullopt;
    const Vec3 wi = d / distance;
    const float share = falloff(-wi);
    if (!(share > 0)) return std::nullopt;
    return Illumination{wi, distance, intensity * (share / (distance * distance)), 0};
  }

  /// Returns the share of the intensity that goes in direction w.
  constexpr float falloff(const Vec3& w) const {
    const float versine = versine_of(w);
    if (versine <= inner) return 1;
    if (versine >= outer) return 0;
    const float x = (outer - versine) / (outer - inner);
    return x * x * (3 - 2 * x);
  }

 private:
  constexpr float versine_of(const Vec3& w) const { return 0.5f * length2(w - basis.z); }
  /// Returns the inner cone's share of the power.
  constexpr float share_of_inner() const { return 2 * inner / (inner + outer); }

  /// The x in [0, 1] with 2 x^3 - x^4 = u: inverts the integral of 2 (3 x^2 - 2 x^3).
  static constexpr float sample_falloff(float u) {
    if (!(u > 0)) return 0;
    // Newton's steps from above never overshoot, because the function is convex; the fifth no longer changes anything.
    float x = rounded::cbrt(u);
    for (int i = 0; i < 5; ++i) x -= (x * x * x * (2 - x) - u) / (x * x * (6 - 4 * x));
    return std::clamp(x, 0.f, 1.f);
  }
};

}  // namespace dspm
