// The index of refraction of a body, which may differ with the wavelength: glass then shows colours.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "dspm/base/colour/spectral_curve.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/bsdf.h"
#include "dspm/shapes/shape.h"

namespace dspm {

/// An index of refraction as a plain value, which a device can have.
struct PlainIndex {
  float mean = 1;                // used wherever light is not refracted by its wavelength
  const float* by_nm = nullptr;  // from kFirstNm to kLastNm; null: it is constant

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(by_nm, static_cast<std::size_t>(kLastNm - kFirstNm + 1));
  }

  constexpr bool disperses() const { return by_nm != nullptr; }
  constexpr float at(const Wavelength& w) const {
    return w.nm == 0 || !disperses() ? mean : by_nm[(w.nm < 0 ? -w.nm : w.nm) - kFirstNm];
  }
};

class RefractiveIndex {
 public:
  explicit RefractiveIndex(float constant) : mean_(constant) {}
  /// Takes the index between 360 and 830 nm from the spectrum, beyond whose ends it is constant. `mean` is used wherever
  /// light is not refracted.
  RefractiveIndex(const SpectralCurve& spectrum, float mean);
  /// Returns the index that is `eta` at 587.6 nm and has this Abbe number, (eta - 1) / (eta_F - eta_C) at 486.1 and 656.3
  /// nm, by Cauchy's equation a + b / nm^2. Infinite: it is constant.
  static RefractiveIndex of_abbe(float eta, float abbe);

  float mean() const { return mean_; }
  bool disperses() const { return by_nm_ != nullptr; }
  float at(const Wavelength& wavelength) const { return plain().at(wavelength); }
  float lowest() const;
  /// This must outlive it.
  PlainIndex plain() const { return {mean_, by_nm_ == nullptr ? nullptr : by_nm_->data()}; }

 private:
  float mean_;
  std::shared_ptr<const std::vector<float>> by_nm_;  // null: it is constant
};

/// Reads "eta" (a number, or a spectrum), "glass" and "abbe".
RefractiveIndex read_refractive_index(ParamReader& reader);

/// How the surface of a body refracts light at a point, of the wavelength of the path that has met it.
struct Refraction {
  float eta;       // inside over outside, at that wavelength
  float mean_eta;  // of all wavelengths
  Wavelength wavelength = {};

  Refraction(float at_wavelength, float mean, const Wavelength& of)
      : eta(at_wavelength), mean_eta(mean), wavelength(of), hue_(of.hue_on_refraction()) {}
  Refraction(const RefractiveIndex& inside, const SurfacePoint& point);
  constexpr Refraction(const PlainIndex& inside, const PlainIndex& outside, const HuedWavelength& of)
      : Refraction(inside, outside.mean, outside.at(of.of) / outside.mean, of.of) {
    if (disperses()) hue_ = of.hue_on_refraction();
  }

  constexpr bool disperses() const { return wavelength.nm != 0; }
  /// Returns whether what is mirrored on that side (+1 outside) depends on the wavelength. Where light comes from what is
  /// less dense it hardly does, so light keeps all of its colours; from what is denser, some wavelengths are mirrored
  /// totally, and others are not.
  constexpr bool mirrors_by_wavelength(float side) const {
    return disperses() && (wavelength.alone || eta_from(side) < 1);
  }
  /// The index by which it is mirrored on that side, beyond over here.
  constexpr float mirroring_eta(float side) const {
    const float inside_over_outside = mirrors_by_wavelength(side) ? eta : mean_eta;
    return side > 0 ? inside_over_outside : 1 / inside_over_outside;
  }
  constexpr float eta_from(float side) const { return side > 0 ? eta : 1 / eta; }
  /// The hue of what is mirrored on that side, and of what passes.
  constexpr Spectrum hue_of_mirrored(float side) const {
    return mirrors_by_wavelength(side) ? hue_of_refracted() : Spectrum(1);
  }
  constexpr Spectrum hue_of_refracted() const { return hue_; }
  /// Gives a sample that leaves on the other side, or is mirrored on that `side`, its hue.
  constexpr void apply_to(BsdfSample& sample, bool refracted, float side) const {
    if (!disperses()) return;
    sample.weight *= refracted ? hue_of_refracted() : hue_of_mirrored(side);
    sample.by_wavelength = refracted || mirrors_by_wavelength(side);
  }
  friend constexpr bool operator==(const Refraction&, const Refraction&) = default;

 private:
  /// See SurfacePoint. It has no hue yet.
  constexpr Refraction(const PlainIndex& inside, float outside_eta, float outside_dispersion, const Wavelength& of)
      : eta(inside.mean / outside_eta), mean_eta(eta) {
    if (of.nm == 0 || !(inside.disperses() || outside_dispersion != 1)) return;
    eta = inside.at(of) / (outside_eta * outside_dispersion);
    wavelength = of;
  }

  Spectrum hue_{1};  // looked up when it is constructed, as a device has no table of hues
};

}  // namespace dspm
