#include "dspm/materials/refractive_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"

namespace dspm {
namespace {

constexpr float kYellowNm = 587.56f, kBlueNm = 486.13f, kRedNm = 656.27f;  // d, F and C: lines of helium and hydrogen

std::vector<float> by_nm(const SpectralCurve& spectrum) {
  std::vector<float> values;
  for (int nm = kFirstNm; nm <= kLastNm; ++nm)
    values.push_back(spectrum.at(std::clamp(static_cast<float>(nm), spectrum.nm.front(), spectrum.nm.back())));
  return values;
}

/// The glasses by their own names: three of pbrt's are those of other glasses.
std::vector<std::string> glasses() {
  constexpr std::string_view kPrefix = "glass-", kMisnamed[] = {"glass-F5", "glass-F10", "glass-F11"};
  std::vector<std::string> names;
  for (const std::string& name : spectrum_names())
    if (name.starts_with(kPrefix) && std::ranges::find(kMisnamed, name) == std::end(kMisnamed))
      names.push_back(name.substr(kPrefix.size()));
  return names;
}

bool is_constant(const SpectralCurve& spectrum) {
  return std::ranges::all_of(spectrum.values, [&](float value) { return value == spectrum.values.front(); });
}

}  // namespace

RefractiveIndex::RefractiveIndex(const SpectralCurve& spectrum, float mean) : mean_(mean) {
  if (!is_constant(spectrum)) by_nm_ = std::make_shared<const std::vector<float>>(by_nm(spectrum));
}

RefractiveIndex RefractiveIndex::of_abbe(float eta, float abbe) {
  if (!std::isfinite(abbe) || eta == 1) return RefractiveIndex(eta);
  const auto inverse_square = [](float nm) { return 1 / (nm * nm); };
  const float b = (eta - 1) / (abbe * (inverse_square(kBlueNm) - inverse_square(kRedNm)));
  SpectralCurve spectrum;
  for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
    const float at = static_cast<float>(nm);
    spectrum.nm.push_back(at);
    spectrum.values.push_back(eta + b * (inverse_square(at) - inverse_square(kYellowNm)));
  }
  return {spectrum, eta};
}

float RefractiveIndex::lowest() const { return disperses() ? *std::ranges::min_element(*by_nm_) : mean_; }

RefractiveIndex read_refractive_index(ParamReader& reader) {
  constexpr float kUsual = 1.5f, kLeastAbbe = 1;
  const auto error = [&](std::string_view name, const std::string& message) {
    reader.error(name, fmt::format("parameter \"{}\" of {} {}", name, reader.subject(), message));
    return RefractiveIndex(kUsual);
  };
  const auto [colour, spectrum] =
      reader.colour_or_spectrum("eta", Rgb(kUsual), SpectrumRole::unbounded, "index of refraction inside over outside");
  const std::string glass =
      reader.text("glass", "", "instead of eta: BK7, SF11, F2, silica, water, diamond, sapphire, ...");
  const float abbe =
      reader.number("abbe", 0, "", "Abbe number, with eta at 587.6 nm; 0: no dispersion, unless eta is a spectrum");
  if (!(abbe >= 0)) return error("abbe", "must be at least 1, or 0 for no dispersion");
  // A keyed number that starts at 0 passes values that no glass has.
  if (abbe > 0 && abbe < kLeastAbbe)
    reader.diagnostics().note(reader.where("abbe"), fmt::format("the Abbe number {:.3g} is rendered as 1", abbe),
                              "real glasses have 20 to 90; 0 is no dispersion");
  if (!glass.empty() && (reader.has("eta") || reader.has("abbe")))
    return error("glass", "already determines the index: leave out \"eta\" and \"abbe\"");
  if (spectrum && abbe != 0) return error("abbe", "needs \"eta\" as a number: the spectrum has dispersion of its own");
  if (!glass.empty()) {
    const std::vector<std::string> known = glasses();
    if (std::ranges::find(known, glass) != known.end()) {
      const SpectralCurve named = *named_spectrum("glass-" + glass);
      return {named, mean(to_rgb(named, SpectrumRole::unbounded))};
    }
    reader.error("glass", fmt::format("unknown glass \"{}\"", glass), did_you_mean(glass, known));
    return RefractiveIndex(kUsual);
  }
  const float eta = mean(colour);
  if (!(eta > 0)) return error("eta", "must be above 0");
  if (abbe != 0) return RefractiveIndex::of_abbe(eta, std::max(abbe, kLeastAbbe));
  if (!spectrum && (colour.r != colour.g || colour.g != colour.b))
    reader.diagnostics().note(reader.where("eta"), fmt::format("eta is {:.4g}, the mean of its colours", eta),
                              "a spectrum, \"abbe\" or \"glass\" makes dispersion");
  if (!spectrum) return RefractiveIndex(eta);
  const RefractiveIndex index(*spectrum, eta);
  return index.lowest() > 0 ? index : error("eta", "must be above 0 at all wavelengths");
}

Refraction::Refraction(const RefractiveIndex& inside, const SurfacePoint& point)
    : Refraction(inside.plain(), point.outside_eta, point.outside_dispersion, point.wavelength) {
  if (disperses()) hue_ = wavelength.hue_on_refraction();
}

}  // namespace dspm
