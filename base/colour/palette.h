// Between what authors say of colours and what paths carry (spectrum.h).
#pragma once

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"

namespace dspm {

class Palette {
 public:
  /// The palette of renders in RGB: nothing changes.
  static const Palette& rgb() { return kRgb; }

  bool is_rgb() const { return true; }
  /// Returns what a path carries of a colour.
  Spectrum carried(const Rgb& c) const { return {c.r, c.g, c.b}; }
  /// Returns what a path carries of light, which may be of any strength.
  Spectrum light(const Rgb& c) const { return {c.r, c.g, c.b}; }
  /// Returns what a path sees of absorption or scattering per unit of length. This is linear and never negative, so that of
  /// a bound is a bound.
  Spectrum per_length(const Rgb& c) const { return {c.r, c.g, c.b}; }
  /// Returns the cosine of the phase by which a path longer by so many nm delays light.
  Spectrum interference(float path_nm) const;
  /// Returns the colour of what a path has brought.
  Rgb seen(const Spectrum& s) const { return {s[0], s[1], s[2]}; }
  float luminance(const Spectrum& s) const { return dspm::luminance(seen(s)); }
  /// The colour of a component of 1.
  Rgb seen(int component) const;

 private:
  static const Palette kRgb;
};

}  // namespace dspm
