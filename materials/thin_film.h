// A film so thin that what its two faces mirror interferes: soap, oil on water, anodised titanium. It lies between air
// and a base, and absorbs nothing.
//
// With r12 and r23 the amplitudes that its faces mirror, R12 and R23 their squares, x = r12 r23 and a light path longer
// by D = 2 n d cos(inside), Airy's sum of all reflections between the faces is
//   R = 1 - (1 - R12) (1 - R23) / |1 + x e^(i phase)|^2
//     = 1 - (1 - R12) (1 - R23) / (1 - x^2) (1 + 2 sum over m >= 1 of (-x)^m cos(m phase)),
// and over all wavelengths cos(m phase) is the colour interference(m D). So white stays white: R23 = 1 gives R = 1. A
// spectral render takes Airy's sum at its wavelengths.
// [Belcour and Barla 2017; glTF 2.0, KHR_materials_iridescence]
#pragma once

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/spectrum.h"

namespace dspm {

class ThinFilm {
 public:
  /// Takes `eta` of the film, at least 1. From 30 nm down it becomes that of air, so that no film is the limit of thin
  /// ones.
  ThinFilm(float eta, float nm, const Palette& palette);

  /// Returns what it mirrors with a base that alone mirrors `straight` straight on. `cos` is that in air.
  Spectrum over_metal(const Spectrum& straight, float cos) const;
  /// Returns what it mirrors with a dielectric base of that index.
  Spectrum over_dielectric(float eta_base, float cos) const;
  /// Returns the most that a film of that index, whatever its thickness, adds to what a dielectric mirrors, for any
  /// angle.
  static float most_gain(float eta, float eta_base);

 private:
  /// `inner` is what the inner face alone mirrors at this angle; `amplitude` is that straight on, for its sign.
  Spectrum mirrored(const Spectrum& inner, const Spectrum& amplitude, float cos) const;
  float cos_inside(float cos) const;

  float eta_, nm_;
  const Palette* palette_;
};

}  // namespace dspm
