// ParamReader's colours: rgb, black bodies, and spectra by name, from a file or as pairs of wavelength and value.
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/number_file.h"

namespace dspm {
namespace {

const std::vector<ParamType> kColourTypes{ParamType::number, ParamType::rgb, ParamType::spectrum, ParamType::blackbody};

std::string default_text(const Rgb& c) { return fmt::format("{:g} {:g} {:g}", c.r, c.g, c.b); }

Colour named_colour(std::string_view name, SpectrumRole role) { return Colour::of(named_spectrum(name).value(), role); }

/// Returns the error in the pairs of a sampled spectrum; empty if they are fine.
std::string fault(const std::vector<float>& pairs) {
  if (pairs.empty() || pairs.size() % 2 != 0)
    return fmt::format("takes pairs of wavelength (nm) and value, got {} numbers", pairs.size());
  for (std::size_t i = 2; i < pairs.size(); i += 2)
    if (!(pairs[i] > pairs[i - 2]))
      return fmt::format("needs ascending wavelengths, got {} after {}", pairs[i], pairs[i - 2]);
  return {};
}

}  // namespace

Rgb ParamReader::rgb(std::string_view name, Rgb fallback, SpectrumRole role, std::string_view sentence) {
  return take_colour(name, {fallback}, default_text(fallback), role, false, sentence).value;
}

Colour ParamReader::colour(std::string_view name, Rgb fallback, SpectrumRole role, std::string_view sentence) {
  const auto taken = take_colour(name, {fallback}, default_text(fallback), role, false, sentence);
  return {taken.value, taken.spectrum};
}

Rgb ParamReader::rgb(std::string_view name, std::string_view named_fallback, SpectrumRole role,
                     std::string_view sentence) {
  const std::string default_value = fmt::format("\"{}\"", named_fallback);
  return take_colour(name, named_colour(named_fallback, role), default_value, role, false, sentence).value;
}

ColourOrSpectrum ParamReader::colour_or_spectrum(std::string_view name, Rgb fallback, SpectrumRole role,
                                                 std::string_view sentence) {
  const Param* param = take(name, kColourTypes, default_text(fallback), {}, sentence);
  if (param == nullptr) return {fallback, {}};
  if (param->type != ParamType::spectrum) return {colour_of(*param, role).value_or(Colour{fallback}).rgb, {}};
  std::optional<SpectralCurve> given = spectrum(*param);
  const Rgb seen = given ? to_rgb(*given, role) : fallback;
  return {seen, std::move(given)};
}

ValueOrTexture<Rgb> ParamReader::rgb_or_texture(std::string_view name, Rgb fallback, SpectrumRole role,
                                                std::string_view sentence) {
  return take_colour(name, {fallback}, default_text(fallback), role, true, sentence);
}

ValueOrTexture<Rgb> ParamReader::rgb_or_texture(std::string_view name, std::string_view named_fallback,
                                                SpectrumRole role, std::string_view sentence) {
  const std::string default_value = fmt::format("\"{}\"", named_fallback);
  return take_colour(name, named_colour(named_fallback, role), default_value, role, true, sentence);
}

ValueOrTexture<Rgb> ParamReader::take_colour(std::string_view name, const Colour& fallback, std::string default_value,
                                             SpectrumRole role, bool textures, std::string_view sentence) {
  Types types = kColourTypes;
  if (textures) types.push_back(ParamType::texture);
  const Param* param = take(name, types, std::move(default_value), {}, sentence);
  ValueOrTexture<Rgb> taken{fallback.rgb, {}, where(name), fallback.spectrum};
  if (!param) {
    if (role == SpectrumRole::illuminant) taken.value = to_rec709(fallback.rgb, space(), role);
  } else if (param->type == ParamType::texture) {
    taken.where = param->values_where;
    if (count_is(*param, 1)) taken.texture = std::get<std::vector<std::string>>(param->values).front();
  } else {
    const Colour given = colour_of(*param, role).value_or(fallback);
    taken = {given.rgb, {}, param->values_where, given.spectrum};
  }
  if (role == SpectrumRole::illuminant && !illuminant_) illuminant_ = taken.spectrum;
  return taken;
}

std::vector<Rgb> ParamReader::colours(std::string_view name, SpectrumRole role, std::string_view sentence) {
  const std::vector<float> v = take_groups(name, {ParamType::rgb}, 3, sentence);
  const Param* const param = v.empty() ? nullptr : find(name);
  std::vector<Rgb> colours(v.size() / 3);
  for (std::size_t i = 0; i < colours.size(); ++i)
    colours[i] = to_rec709({v[3 * i], v[3 * i + 1], v[3 * i + 2]}, param != nullptr ? param->space : space(), role);
  return colours;
}

std::optional<Colour> ParamReader::colour_of(const Param& param, SpectrumRole role) {
  if (param.type == ParamType::spectrum) {
    const std::optional<SpectralCurve> given = spectrum(param);
    return given ? std::optional(Colour::of(*given, role)) : std::nullopt;
  }
  if (!count_is(param, param.type == ParamType::rgb ? 3 : 1)) return std::nullopt;
  const std::vector<float> v = numbers_of(param);
  std::string wrong;
  if (param.type == ParamType::blackbody) {
    if (v[0] > 0) return Colour::of(blackbody(v[0]), role);
    wrong = "must be a temperature above 0 K";
  } else {
    const Rgb rgb = param.type == ParamType::rgb ? Rgb(v[0], v[1], v[2]) : Rgb(v[0]);
    if (rgb.r < 0 || rgb.g < 0 || rgb.b < 0)
      wrong = "must not be negative";
    else if (role == SpectrumRole::albedo && max_component(rgb) > 1)
      wrong = "must lie in 0..1";
    else
      return role == SpectrumRole::unbounded && param.type == ParamType::number ? Colour{rgb}
                                                                                : Colour::of(rgb, param.space, role);
  }
  diagnostics_.error(param.values_where, fmt::format("{} {}", quoted(param.name), wrong));
  return std::nullopt;
}

std::optional<SpectralCurve> ParamReader::spectrum(const Param& param) {
  const auto* texts = std::get_if<std::vector<std::string>>(&param.values);
  if (!texts) return spectrum_from_pairs(param, numbers_of(param));
  if (!count_is(param, 1)) return std::nullopt;
  if (auto named = named_spectrum(texts->front())) return named;
  return spectrum_from_file(param, texts->front());
}

std::optional<SpectralCurve> ParamReader::spectrum_from_file(const Param& param, const std::string& name) {
  const std::filesystem::path path = existing_file(param, name);
  if (path.empty()) {
    diagnostics_.error(param.values_where, fmt::format("unknown spectrum \"{}\", and no file has that name", name),
                       did_you_mean(name, spectrum_names()));
    return std::nullopt;
  }
  try {
    return spectrum_from_pairs(param, read_numbers(path));
  } catch (const std::runtime_error& error) {
    diagnostics_.error(param.values_where, fmt::format("\"{}\" cannot be read: {}", path.string(), error.what()));
    return std::nullopt;
  }
}

std::optional<SpectralCurve> ParamReader::spectrum_from_pairs(const Param& param, const std::vector<float>& pairs) {
  const std::string wrong = fault(pairs);
  if (!wrong.empty()) {
    diagnostics_.error(param.values_where, fmt::format("{} {}", quoted(param.name), wrong));
    return std::nullopt;
  }
  SpectralCurve spectrum;
  for (std::size_t i = 0; i < pairs.size(); i += 2) {
    spectrum.nm.push_back(pairs[i]);
    spectrum.values.push_back(pairs[i + 1]);
  }
  return spectrum;
}

}  // namespace dspm
