// Parameters that several materials share, as plain values, which devices can have. parameters.h reads them.
#pragma once

#include <algorithm>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/microfacet.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/textures/plain_mapping.h"
#include "dspm/textures/plain_value.h"

namespace dspm {

/// The place at which textures are looked up.
constexpr PlainPlace place_of(const SurfaceGeometry& point) { return {point.p, point.uv}; }

struct PlainRoughness {
  PlainValue<float> u, v;
  bool remap = false;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    u.each_array(fn);
    v.each_array(fn);
  }

  /// Returns GGX alpha along the tangent and across it.
  constexpr Vec2 alpha(const PlainPlace& place) const {
    const Vec2 roughness{u.at(place), v.at(place)};
    return remap ? Vec2{roughness_to_alpha(roughness.x), roughness_to_alpha(roughness.y)} : roughness;
  }
};

struct PlainMetal {
  bool by_reflectance = false;  // at normal incidence; there is no k then
  PlainValue<Rgb> eta_or_reflectance, k;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    eta_or_reflectance.each_array(fn);
    k.each_array(fn);
  }

  constexpr MetalIndex index(const PlainPlace& place) const {
    const Spectrum value = eta_or_reflectance.at(place);
    if (!by_reflectance) return {value, k.at(place)};
    MetalIndex index{Spectrum(1), Spectrum(0)};
    for (int c = 0; c < 3; ++c) {
      // As in pbrt: never quite 1, because k would be infinite.
      const float r = std::clamp(value[c], 0.f, 0.9999f);
      index.k[c] = 2 * rounded::sqrt(r / (1 - r));
    }
    return index;
  }
};

}  // namespace dspm
