// A material as a plain value, which a device can have: one of a few kinds, whose textures are plain (plain_texture.h).
#pragma once

#include "dspm/materials/coated_conductor_bsdf.h"
#include "dspm/materials/coated_diffuse_bsdf.h"
#include "dspm/materials/conductor_bsdf.h"
#include "dspm/materials/dielectric_bsdf.h"
#include "dspm/materials/diffuse_bsdf.h"
#include "dspm/materials/diffuse_transmission_bsdf.h"
#include "dspm/materials/thin_dielectric_bsdf.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

class PlainMaterial {
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
  constexpr PlainMaterial(const PlainDiffuse& diffuse) : kind_(Kind::diffuse), diffuse_(diffuse) {}
  constexpr PlainMaterial(const PlainDielectric& dielectric) : kind_(Kind::dielectric), dielectric_(dielectric) {}
  constexpr PlainMaterial(const PlainConductor& conductor) : kind_(Kind::conductor), conductor_(conductor) {}
  constexpr PlainMaterial(const PlainThinDielectric& pane) : kind_(Kind::thin_dielectric), thin_dielectric_(pane) {}
  constexpr PlainMaterial(const PlainCoatedDiffuse& coated) : kind_(Kind::coated_diffuse), coated_diffuse_(coated) {}
  constexpr PlainMaterial(const PlainCoatedConductor& coated)
      : kind_(Kind::coated_conductor), coated_conductor_(coated) {}
  constexpr PlainMaterial(const PlainDiffuseTransmission& leaf)
      : kind_(Kind::diffuse_transmission), diffuse_transmission_(leaf) {}

  /// Calls fn(const Plain&) with the Bsdf at the point (plain_bsdf.h), and returns what it does: one type for all Bsdfs.
  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const Fn& fn) const {
    switch (kind_) {
      case Kind::diffuse: return diffuse_.with_bsdf(point, fn);
      case Kind::dielectric: return dielectric_.with_bsdf(point, fn);
      case Kind::conductor: return conductor_.with_bsdf(point, fn);
      case Kind::thin_dielectric: return thin_dielectric_.with_bsdf(point, fn);
      case Kind::coated_diffuse: return coated_diffuse_.with_bsdf(point, fn);
      case Kind::coated_conductor: return coated_conductor_.with_bsdf(point, fn);
      case Kind::diffuse_transmission: break;
    }
    return diffuse_transmission_.with_bsdf(point, fn);
  }
  /// Returns whether paths that stand for more than a point average a texture of it (Material::averages) that varies: they
  /// see something else than with_bsdf() gives.
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
      case Kind::thin_dielectric: break;
    }
    fn(thin_dielectric_);
  }
  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    of_kind([&](auto& kind) { kind.each_array(fn); });
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

}  // namespace dspm
