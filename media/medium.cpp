#include "dspm/media/medium.h"

namespace dspm {
namespace {

/// Returns what paths see of a coefficient that is a multiple of `of`.
Spectrum multiple(const Rgb& sigma, const Colour& of, const Palette& palette) {
  if (palette.is_rgb() || !of.spectrum) return palette.per_length(sigma);
  const float unit = mean(of.rgb);
  return unit > 0 ? palette.at_its(*of.spectrum) * (mean(sigma) / unit) : Spectrum();
}

}  // namespace

CarriedMedium Medium::carried(const MediumProperties& here, const Palette& palette) const {
  return {multiple(here.sigma_a, spectra_.sigma_a, palette), multiple(here.sigma_s, spectra_.sigma_s, palette),
          palette.light(here.emitted, spectra_.emitted.get()), here.g};
}

}  // namespace dspm
