// The wavelength of an iteration. Light may be carried in RGB, but glass refracts light by its wavelength. So each iteration has
// one, the same for all paths, photons and frames: a path that is refracted by it goes on with light of that wavelength
// only, and takes on its hue. Other paths carry all colours, and pixels share the wavelength, so there is no colour noise
// between pixels. [after Wilkie et al. 2014, Hero Wavelength Spectral Sampling, with one hero for all paths of an
// iteration]
#pragma once

#include <array>
#include <cstdint>

#include "dspm/base/colour/spectral_curve.h"
#include "dspm/base/colour/spectrum.h"

namespace dspm {

struct Wavelength {
  // 0: nothing in the scene refracts by wavelength. Negative: the render is spectral, and it is the first of the three.
  std::int16_t nm = 0;
  bool alone = false;  // the path has been refracted by it: its light has no other
  // The path's throughput is then multiplied by the hue; if not, whoever adds its light multiplies by it.
  bool weighs = false;

  /// Returns the factor to f where the path is refracted by its wavelength: its hue, or 1.
  Spectrum hue_on_refraction() const;
  constexpr bool gets_hue_on_refraction() const { return weighs && !alone; }
  /// Returns the wavelength if the path's light has it alone and lacks its hue, else 0.
  constexpr std::int16_t only_nm() const { return alone && !weighs ? nm : std::int16_t{0}; }
  friend constexpr bool operator==(const Wavelength&, const Wavelength&) = default;
};

/// Returns a number in [0, 1) for each iteration. Those of 2, 4, 8, 16 or 32 iterations are equally far apart, if 0 is next
/// to 1, and three such sets a third apart are so, too; blocks of 32 are apart by the golden ratio, so that every second or
/// fourth iteration alone covers all in the end.
double place_among_wavelengths(std::uint64_t seed, std::uint64_t iteration);
/// Returns the wavelength of the iteration.
std::int16_t wavelength_of(std::uint64_t seed, std::uint64_t iteration);
/// Returns the wavelength for a number in [0, 1), with that density.
std::int16_t wavelength_at(double u);
/// Returns the probability of the wavelength, a whole number of nm.
double wavelength_probability(int nm);

/// Returns what light of that wavelength adds to white daylight, in Rec. 709: negative where its colour lies outside, and 1
/// over all wavelengths.
std::array<double, 3> part_of_white(int nm);

/// Returns what is left of white light that goes on with that wavelength alone, see Wavelength::nm: white on average. In
/// a spectral render, the first component; else the colour of daylight of that wavelength, over its probability. It is
/// never negative: what lies outside Rec. 709 is clamped to it.
Spectrum hue(int nm);

inline Spectrum Wavelength::hue_on_refraction() const { return gets_hue_on_refraction() ? hue(nm) : Spectrum(1); }

/// A wavelength with its hue, for devices, which have no table of hues.
struct HuedWavelength {
  Wavelength of = {};
  Spectrum hue{1};

  HuedWavelength() = default;
  explicit HuedWavelength(const Wavelength& wavelength) : of(wavelength) {
    if (of.nm != 0) hue = dspm::hue(of.nm);
  }

  /// Returns that of a path whose light has it alone, or not.
  constexpr HuedWavelength of_path(bool alone) const {
    HuedWavelength wavelength = *this;
    wavelength.of.alone = alone;
    return wavelength;
  }
  constexpr Spectrum hue_on_refraction() const { return of.gets_hue_on_refraction() ? hue : Spectrum(1); }
};

/// Returns the factor to light that a camera path finds, if that light has one wavelength and lacks its hue; 0: it has all
/// colours. The hue counts once: the throughput of a camera path of one wavelength has it already.
inline Spectrum hue_of_found(int only_nm, bool camera_is_alone) {
  return only_nm != 0 && !camera_is_alone ? hue(only_nm) : Spectrum(1);
}

}  // namespace dspm
