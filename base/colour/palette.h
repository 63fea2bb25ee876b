// Between what authors say of colours and what the paths of an iteration carry (spectrum.h). A spectral render has three
// wavelengths in each iteration, the same for all paths, photons and frames, so pixels have no colour noise of their own.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "dspm/base/colour/colour.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"

namespace dspm {

class Sensor;

class Palette {
 public:
  /// The palette of renders in RGB: nothing changes.
  static const Palette& rgb() { return kRgb; }
  /// That of an iteration of a spectral render. The wavelengths of consecutive iterations are spread evenly, by how much each
  /// contributes to white. Null is the sensor of the observer of 1931.
  static std::shared_ptr<const Palette> of_iteration(std::uint64_t seed, std::uint64_t iteration,
                                                     const Sensor* sensor = nullptr);

  bool is_rgb() const { return spectral_ == nullptr; }
  /// The wavelength of a component, if it is not RGB.
  int nm(int component) const;

  /// Returns what a path carries of a reflectance, or of whatever is never negative and rarely above 1.
  Spectrum carried(const Rgb& c) const { return is_rgb() ? Spectrum(c.r, c.g, c.b) : smooth(c, 1); }
  Spectrum carried(const Colour& c) const { return is_rgb() || !c.spectrum ? carried(c.rgb) : at_its(*c.spectrum); }
  /// Returns what a path carries of light, which may be of any strength: what it carries of a reflectance of half the
  /// strength, times two, as in pbrt-v4.
  Spectrum light(const Rgb& c) const { return is_rgb() ? Spectrum(c.r, c.g, c.b) : smooth(c, 2 * max_component(c)); }
  /// The same of a multiple of light with a spectrum; null: the colour says all.
  Spectrum light(const Rgb& c, const SpectrumByNm* spectrum) const {
    return is_rgb() || spectrum == nullptr ? light(c) : at_its(*spectrum) * dspm::luminance(c);
  }
  /// Returns what a path sees of absorption or scattering per unit of length. This is linear and never negative, so that of
  /// a bound is a bound.
  Spectrum per_length(const Rgb& c) const { return is_rgb() ? Spectrum(c.r, c.g, c.b) : blended(c); }
  Spectrum per_length(const Colour& c) const {
    return is_rgb() || !c.spectrum ? per_length(c.rgb) : at_its(*c.spectrum);
  }
  /// Returns the values of a spectrum at its wavelengths; not for RGB.
  Spectrum at_its(const SpectrumByNm& spectrum) const;
  /// Returns the cosine of the phase by which a path longer by so many nm delays light.
  Spectrum interference(float path_nm) const;

  /// Returns the colour of what a path has brought. Spectral ones may be negative; their mean over iterations is the
  /// colour in Rec. 709.
  Rgb seen(const Spectrum& s) const { return is_rgb() ? Rgb(s[0], s[1], s[2]) : matched(s); }
  /// Never negative.
  float luminance(const Spectrum& s) const { return dspm::luminance(seen(s)); }
  /// The colour of a component of 1.
  Rgb seen(int component) const;

 private:
  struct Spectral;

  Palette() = default;
  explicit Palette(std::shared_ptr<const Spectral> spectral) : spectral_(std::move(spectral)) {}
  Spectrum smooth(const Rgb& c, float most) const;
  Spectrum blended(const Rgb& c) const;
  Rgb matched(const Spectrum& s) const;

  static const Palette kRgb;
  std::shared_ptr<const Spectral> spectral_;  // null: RGB
};

}  // namespace dspm
