// The parameters that media have in common.
#pragma once

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/media/medium.h"

namespace dspm {

/// Absorption and scattering per unit of length, where the density is 1.
struct Coefficients {
  Rgb sigma_a, sigma_s;
  float g = 0;
  MediumSpectra spectra = {};  // for Medium::set_spectra()
};

/// Reads "preset", "sigma_a", "sigma_s", "scale" and "g".
Coefficients read_coefficients(ParamReader& reader, const Rgb& sigma_a, const Rgb& sigma_s);

/// Reads "Le": the radiance that what absorbs gives off. By wavelength it goes into the spectra.
Rgb read_emitted_radiance(ParamReader& reader, Coefficients& coefficients);

}  // namespace dspm
