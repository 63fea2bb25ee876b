// A material as a plain value, which a device can have: one of a few kinds, whose textures are plain (plain_texture.h).
#pragma once

#include "dspm/base/colour/wavelength.h"
#include "dspm/materials/conductor_bsdf.h"
#include "dspm/materials/dielectric_bsdf.h"
#include "dspm/materials/diffuse_bsdf.h"
#include "dspm/materials/thin_dielectric_bsdf.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

class PlainMaterial {
  enum class Kind : unsigned char { diffuse, dielectric, conductor, thin_dielectric };

 public:
  constexpr PlainMaterial(const PlainDiffuse& diffuse) : kind_(Kind::diffuse), diffuse_(diffuse) {}
  constexpr PlainMaterial(const PlainDielectric& dielectric) : kind_(Kind::dielectric), dielectric_(dielectric) {}
  constexpr PlainMaterial(const PlainConductor& conductor) : kind_(Kind::conductor), conductor_(conductor) {}
  constexpr PlainMaterial(const PlainThinDielectric& pane) : kind_(Kind::thin_dielectric), thin_dielectric_(pane) {}

  /// Calls fn(const Plain&) with the Bsdf (plain_bsdf.h) at a point that a path of that wavelength has met, and returns what
  /// it does: one type for all Bsdfs.
  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const HuedWavelength& wavelength,
                                     const Fn& fn) const {
    switch (kind_) {
      case Kind::diffuse: return diffuse_.with_bsdf(point, fn);
      case Kind::dielectric: return dielectric_.with_bsdf(point, wavelength, fn);
      case Kind::conductor: return conductor_.with_bsdf(point, fn);
      case Kind::thin_dielectric: break;
    }
    return thin_dielectric_.with_bsdf(point, fn);
  }

  /// Returns whether paths that stand for more than a point average a texture of it (Material::averages) that varies: they
  /// see something else than with_bsdf() gives.
  constexpr bool averages() const { return kind_ == Kind::diffuse && diffuse_.reflectance.varies(); }

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
  };
};

}  // namespace dspm
