#include "dspm/media/coefficients.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "dspm/base/colour/smooth_spectra.h"
#include "dspm/media/measured_media.h"

namespace dspm {
namespace {

/// Returns sigma_a Le by wavelength, over the luminance of the product of their colours; null if sigma_a is grey and
/// Le has no spectrum: then the product's own colour says the same.
std::shared_ptr<const SpectrumByNm> emitted_spectrum(const Coefficients& coefficients, const Colour& radiance) {
  const Rgb &sigma_a = coefficients.sigma_a, &Le = radiance.rgb;
  const std::shared_ptr<const SpectrumByNm>& absorbed = coefficients.spectra.sigma_a.spectrum;
  const float luminous = luminance(sigma_a * Le);
  const bool is_grey = !absorbed && sigma_a.r == sigma_a.g && sigma_a.g == sigma_a.b;
  if (!(luminous > 0) || (is_grey && !radiance.spectrum)) return nullptr;
  const float strength = 2 * max_component(Le), unit = mean(coefficients.spectra.sigma_a.rgb);  // see Palette::light()
  const SmoothSpectrum smooth(Le / strength, {});
  return std::make_shared<const SpectrumByNm>([&](int nm) {
    const auto [red, green, blue] = SmoothSpectra::all().shares(nm);
    const float sigma = absorbed ? absorbed->at(nm) * mean(sigma_a) / unit
                                 : red * sigma_a.r + green * sigma_a.g + blue * sigma_a.b,
                shining = radiance.spectrum ? radiance.spectrum->at(nm) * luminance(Le) : strength * smooth.at(nm);
    return sigma * shining / luminous;
  });
}

}  // namespace

Coefficients read_coefficients(ParamReader& reader, const Rgb& sigma_a, const Rgb& sigma_s) {
  Coefficients read;
  const std::string preset = reader.text("preset", "", "a measured medium such as \"Wholemilk\", per millimetre");
  read.spectra.sigma_a =
      reader.colour("sigma_a", sigma_a, SpectrumRole::unbounded, "absorption per unit of length in the world");
  read.spectra.sigma_s =
      reader.colour("sigma_s", sigma_s, SpectrumRole::unbounded, "scattering per unit of length in the world");
  read.sigma_a = read.spectra.sigma_a.rgb, read.sigma_s = read.spectra.sigma_s.rgb;
  const float scale = reader.number("scale", 1, "", "multiplies both");
  read.g = reader.number("g", 0, "", "mean cosine of scattering, between -1 (back) and 1 (on)");
  if (!preset.empty()) {
    if (reader.has("sigma_a") || reader.has("sigma_s"))
      reader.error("preset", "\"preset\" and \"sigma_a\" or \"sigma_s\" say the same twice", "remove one of them");
    if (const MeasuredMedium* medium = find_measured_medium(reader, "preset", preset)) {
      read.sigma_a = {medium->sigma_a[0], medium->sigma_a[1], medium->sigma_a[2]};
      read.sigma_s = {medium->sigma_s[0], medium->sigma_s[1], medium->sigma_s[2]};
    }
  }
  const auto expect_no_less = [&](const char* name, const Rgb& value) {
    if (!(value.r >= 0 && value.g >= 0 && value.b >= 0))
      reader.error(name, std::string("\"") + name + "\" of " + reader.subject() + " must not be negative");
  };
  expect_no_less("sigma_a", read.sigma_a), expect_no_less("sigma_s", read.sigma_s), expect_no_less("scale", Rgb(scale));
  if (!(std::abs(read.g) < 1)) reader.error("g", "\"g\" of " + reader.subject() + " must be between -1 and 1");
  read.sigma_a *= scale, read.sigma_s *= scale;
  return read;
}

Rgb read_emitted_radiance(ParamReader& reader, Coefficients& coefficients) {
  const Colour radiance = reader.colour("Le", Rgb(0), SpectrumRole::illuminant, "radiance that what absorbs gives off");
  coefficients.spectra.emitted = emitted_spectrum(coefficients, radiance);
  return radiance.rgb;
}

}  // namespace dspm
