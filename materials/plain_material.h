// A material as a plain value, which a device can have: one of a few kinds, whose textures are plain (plain_texture.h), or at
// each point one of two of these.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>

#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/coated_conductor_bsdf.h"
#include "dspm/materials/coated_diffuse_bsdf.h"
#include "dspm/materials/conductor_bsdf.h"
#include "dspm/materials/dielectric_bsdf.h"
#include "dspm/materials/diffuse_bsdf.h"
#include "dspm/materials/diffuse_transmission_bsdf.h"
#include "dspm/materials/plain_parameters.h"
#include "dspm/materials/thin_dielectric_bsdf.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/textures/plain_value.h"

namespace dspm {

/// Returns whether a mix is made of its second material at p; mixes within mixes, which are deeper, choose independently.
constexpr bool takes_second(float amount, const Vec3& p, int depth) {
  if (!(amount > 0) || amount >= 1) return amount >= 1;
  std::uint64_t bits = static_cast<std::uint64_t>(depth);
  for (const float coordinate : {p.x, p.y, p.z})
    bits = mix_bits(bits * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint32_t>(coordinate) + 1);
  return static_cast<float>(bits >> 40) * 0x1p-24f < amount;
}

/// The same material at all points.
class PlainLook {
  enum class Kind : unsigned char {
    diffuse,
    dielectric,
    conductor,
    thin_dielectric,
    coated_diffuse,
    coated_conductor,
    diffuse_transmission
  };

 public:
  constexpr PlainLook(const PlainDiffuse& diffuse) : kind_(Kind::diffuse), diffuse_(diffuse) {}
  constexpr PlainLook(const PlainDielectric& dielectric) : kind_(Kind::dielectric), dielectric_(dielectric) {}
  constexpr PlainLook(const PlainConductor& conductor) : kind_(Kind::conductor), conductor_(conductor) {}
  constexpr PlainLook(const PlainThinDielectric& pane) : kind_(Kind::thin_dielectric), thin_dielectric_(pane) {}
  constexpr PlainLook(const PlainCoatedDiffuse& coated) : kind_(Kind::coated_diffuse), coated_diffuse_(coated) {}
  constexpr PlainLook(const PlainCoatedConductor& coated) : kind_(Kind::coated_conductor), coated_conductor_(coated) {}
  constexpr PlainLook(const PlainDiffuseTransmission& leaf)
      : kind_(Kind::diffuse_transmission), diffuse_transmission_(leaf) {}

  /// See PlainMaterial.
  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const HuedWavelength& wavelength,
                                     const Fn& fn) const {
    switch (kind_) {
      case Kind::diffuse: return diffuse_.with_bsdf(point, fn);
      case Kind::dielectric: return dielectric_.with_bsdf(point, wavelength, fn);
      case Kind::conductor: return conductor_.with_bsdf(point, fn);
      case Kind::thin_dielectric: return thin_dielectric_.with_bsdf(point, fn);
      case Kind::coated_diffuse: return coated_diffuse_.with_bsdf(point, fn);
      case Kind::coated_conductor: return coated_conductor_.with_bsdf(point, fn);
      case Kind::diffuse_transmission: break;
    }
    return diffuse_transmission_.with_bsdf(point, fn);
  }
  constexpr bool averages() const {
    return (kind_ == Kind::diffuse && diffuse_.reflectance.varies()) ||
           (kind_ == Kind::diffuse_transmission && diffuse_transmission_.varies());
  }

  /// Calls fn(Plain...&) with what it is.
  template <class Fn>
  constexpr void of_kind(Fn&& fn) {
    switch (kind_) {
      case Kind::diffuse: return fn(diffuse_);
      case Kind::dielectric: return fn(dielectric_);
      case Kind::conductor: return fn(conductor_);
      case Kind::thin_dielectric: return fn(thin_dielectric_);
      case Kind::coated_diffuse: return fn(coated_diffuse_);
      case Kind::coated_conductor: return fn(coated_conductor_);
      case Kind::diffuse_transmission: break;
    }
    fn(diffuse_transmission_);
  }

 private:
  Kind kind_;
  union {
    PlainDiffuse diffuse_;
    PlainDielectric dielectric_;
    PlainConductor conductor_;
    PlainThinDielectric thin_dielectric_;
    PlainCoatedDiffuse coated_diffuse_;
    PlainCoatedConductor coated_conductor_;
    PlainDiffuseTransmission diffuse_transmission_;
  };
};

class PlainMaterial {
 public:
  template <std::convertible_to<PlainLook> Look>
  constexpr PlainMaterial(const Look& look) : first_(look), second_(look) {}
  /// A mix; `amount` is the share of the second one.
  constexpr PlainMaterial(const PlainLook& first, const PlainLook& second, const PlainValue<float>& amount)
      : first_(first), second_(second), amount_(amount), is_mix_(true) {}

  /// Calls fn(const Plain&) with the Bsdf (plain_bsdf.h) at a point that a path of that wavelength has met, and returns what
  /// it does: one type for all Bsdfs.
  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const HuedWavelength& wavelength,
                                     const Fn& fn) const {
    return (is_second(point) ? second_ : first_).with_bsdf(point, wavelength, fn);
  }

  /// Calls fn(const Plain&, bool is_there) with the Bsdf that a mix does not have at the point, but may have beside it; and
  /// with the Bsdf at the point, which is there, last.
  template <class Fn>
  constexpr void with_all_beside(const SurfaceGeometry& point, const HuedWavelength& wavelength, const Fn& fn) const {
    const bool second = is_second(point);
    for (int i = is_mix_ ? 0 : 1; i < 2; ++i)
      ((i == 1) == second ? second_ : first_).with_bsdf(point, wavelength, [&](const auto& bsdf) { fn(bsdf, i == 1); });
  }

  /// Returns whether paths that stand for more than a point average a texture of it (Material::averages) that varies: they
  /// see something else than with_bsdf() gives.
  constexpr bool averages() const { return !is_mix_ && first_.averages(); }

  /// Returns what it is at all points; null if it is a mix.
  constexpr const PlainLook* everywhere() const { return is_mix_ ? nullptr : &first_; }

  /// Calls fn(Plain...&) with all that it is made of.
  template <class Fn>
  constexpr void of_kind(Fn&& fn) {
    first_.of_kind(fn), second_.of_kind(fn);
    fn(amount_);
  }
  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    of_kind([&](auto& part) { part.each_array(fn); });
  }

 private:
  constexpr bool is_second(const SurfaceGeometry& point) const {
    return is_mix_ && takes_second(amount_.at(place_of(point)), point.p, 0);
  }

  PlainLook first_, second_;
  PlainValue<float> amount_;
  bool is_mix_ = false;
};

}  // namespace dspm
