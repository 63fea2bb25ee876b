// The scattering function of the principled material: what its parameters are at one point, and the sum of its layers.
#pragma once

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/bsdf.h"
#include "dspm/materials/principled/principled_tables.h"
#include "dspm/materials/refractive_index.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/materials/small_number.h"

namespace dspm {

/// The parameters at a point; all lie in [0, 1].
struct PrincipledLook {
  Spectrum base;
  float metallic, specular;
  Spectrum straight;  // what the opaque dielectric mirrors straight on, if specular is 1
  float transmission;
  float beyond;  // share of the ground's light that leaves on the other side
  Spectrum beyond_colour;
  Vec2 alpha;
  float coat, coat_alpha;
  Spectrum sheen;
  float sheen_alpha;
  Vec3 coat_normal;     // in the world, on the side of ng
  float film, film_nm;  // share of the surface under a thin film, and its thickness
};

inline constexpr float kMostFilmNm = 10'000;  // beyond, it has no colours

class PrincipledLayers;

class Principled final : public Bsdf {
 public:
  static constexpr LobeSet kSpecular = 1, kThrough = 2, kDiffuse = 4, kCoat = 8;

  /// `tables` must outlive it; its index is the refraction's mean, but for those too close to 1.
  Principled(const ShadingFrame& frame, const PrincipledTables& tables, const Refraction& refraction,
             const Palette& palette, const PrincipledLook& look);

  LobeSet lobes(float least_alpha) const override;
  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override;
  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override;
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override;
  float lobe_probability(const Vec3& wo, LobeSet lobes) const override;
  bool transmits(LobeSet lobes) const override {
    return (lobes & this->lobes(0) & (diffuses_beyond() ? kThrough | kDiffuse : kThrough)) != 0;
  }
  bool disperses(const Vec3& wo, const Vec3& wi) const override {
    const float side = frame().side(wo);
    return is_dispersive(side, frame().side(wi) != side);
  }
  std::optional<Spectrum> ratio_to(const Bsdf& other, LobeSet lobes) const override;

 private:
  friend PrincipledLayers;

  Refraction refraction() const { return {eta_, tables_->eta, wavelength_}; }
  /// Returns whether light that passes, or is mirrored on that side, goes by its wavelength.
  bool is_dispersive(float side, bool passes) const;
  Spectrum hue_of(float side, bool passes) const {
    return is_dispersive(side, passes) ? wavelength_.hue_on_refraction() : Spectrum(1);
  }

  bool diffuses_beyond() const { return beyond_ > 0 && transmission_ < 1 && metallic_ < 1; }
  /// Returns whether the other differs in the base colour only.
  bool differs_in_base_from(const Principled& other) const;

  ShadingFrame frame() const { return {ns_, ng_, tangent_}; }

  const PrincipledTables* tables_;
  const Palette* palette_;
  Vec3 ns_, ng_;
  float eta_;  // inside over outside, at the wavelength if there is one
  Wavelength wavelength_;
  SmallDirection tangent_, coat_normal_;  // coat_normal_ is in the frame
  SmallSpectrum base_, sheen_, straight_, beyond_colour_;
  SmallNumber metallic_, specular_, transmission_, beyond_, alpha_x_, alpha_y_, coat_, coat_alpha_, sheen_alpha_;
  SmallNumber film_, film_thickness_;  // of kMostFilmNm
  SmallNumber diffuse_norm_;           // 2 times the integral over the cosine of what reaches the diffuse base
};

}  // namespace dspm
