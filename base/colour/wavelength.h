// The wavelength of an iteration. dspm renders in RGB, but glass refracts light by its wavelength. So each iteration has one,
// the same for all paths, photons and frames: a path that is refracted by it goes on with light of that wavelength only, and
// takes on its hue. Other paths carry all colours, and pixels share the wavelength, so there is no colour noise between
// pixels. [after Wilkie et al. 2014, Hero Wavelength Spectral Sampling, with one hero for all paths of an iteration]
#pragma once

#include <cstdint>

#include "dspm/base/colour/rgb.h"

namespace dspm {

struct Wavelength {
  std::int16_t nm = 0;  // 0: nothing in the scene refracts by wavelength
  bool alone = false;   // the path has been refracted by it: its light has no other
  bool weighs =
      false;  // the path's throughput is multiplied by the hue then; else whoever adds its light multiplies by it

  /// Returns the factor to f where the path is refracted by its wavelength.
  Rgb hue_on_refraction() const;
  /// Returns the wavelength if the path's light has it alone and lacks its hue, else 0.
  std::int16_t only_nm() const { return alone && !weighs ? nm : std::int16_t{0}; }
  friend bool operator==(const Wavelength&, const Wavelength&) = default;
};

inline constexpr int kShortestNm = 360, kLongestNm = 830;  // where the observer sees anything

/// Returns the wavelength of that iteration: any number of iterations that follow one another are spread evenly over the
/// wavelengths, by how much these contribute to white.
std::int16_t wavelength_of(std::uint64_t seed, std::uint64_t iteration);
/// Returns the wavelength for a number in [0, 1), with that density.
std::int16_t wavelength_at(double u);
/// Returns the probability of the wavelength, a whole number of nm.
double wavelength_probability(int nm);

/// Returns the colour of daylight of that wavelength, over its probability: never negative, and white on average. What lies
/// outside Rec. 709 is clamped to it.
Rgb hue(int nm);

inline Rgb Wavelength::hue_on_refraction() const { return weighs && !alone ? hue(nm) : Rgb(1); }

/// Returns the factor to light of that wavelength alone, which lacks its hue, or of all colours (0), that a camera path finds: the
/// hue counts once, and the throughput of a camera path of one wavelength has it.
inline Rgb hue_of_found(int only_nm, bool camera_is_alone) {
  return only_nm != 0 && !camera_is_alone ? hue(only_nm) : Rgb(1);
}

}  // namespace dspm
