// Spectra as scene files give them (named, sampled, black body), and their conversion to linear Rec. 709 RGB.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/base/colour/rgb.h"

namespace dspm {

/// The meaning of a spectrum; it decides the conversion to RGB.
enum class SpectrumRole {
  albedo,      // a reflectance or transmittance: its colour under D65, white being (1, 1, 1), clamped to 0..1
  unbounded,   // an index of refraction or absorption: as albedo, but constant beyond its samples and unlimited
  illuminant,  // emission: its colour at luminance 1, whatever its samples' unit, as in pbrt; "scale" sets the strength
};

inline constexpr int kFirstNm = 360, kLastNm = 830;  // where the observer sees anything

/// A function of wavelength (nm, ascending), linear between samples and, as in pbrt, zero outside.
struct SpectralCurve {
  std::vector<float> nm, values;
  float at(float wavelength) const;
};

/// pbrt's named spectra, and some more glasses: glass-BK7, metal-Cu-eta, stdillum-D65, ...
std::optional<SpectralCurve> named_spectrum(std::string_view name);
std::vector<std::string> spectrum_names();
/// The radiance of a black body over wavelength, its peak scaled to 1.
SpectralCurve blackbody(float kelvin);

/// The CIE XYZ of light, by the observer of 1931.
std::array<double, 3> to_xyz(const SpectralCurve& spectrum);
/// The result is finite and never negative: colours outside Rec. 709 are clamped to it.
Rgb to_rgb(const SpectralCurve& spectrum, SpectrumRole role);

}  // namespace dspm
