// pbrt-v3's lights and media as pbrt-v4's.
#include <algorithm>
#include <cmath>
#include <functional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectral_curve.h"
#include "dspm/base/colour/spectrum_tables.h"
#include "dspm/lang/v3/kinds.h"

namespace dspm::v3 {
namespace {

constexpr Rule kLights[] = {
    {"point", "", "I scale from"},
    {"spot", "", "I scale from to coneangle conedeltaangle"},
    {"goniometric", "", "I scale mapname=filename"},
    {"projection", "", "I scale fov:float45 mapname=filename"},
    {"distant", "", "L scale from to"},
    {"infinite", "", "L scale mapname=filename samples= nsamples="},
    {"diffuse", "", "L scale twosided samples= nsamples="},
    {"area", "diffuse", "L scale twosided samples= nsamples="},
};

/// The luminance of a spectrum's samples. v4 scales an illuminant to luminance 1, v3 left it as it was.
float luminance(const SpectralCurve& spectrum) {
  float sum = 0, whole = 0;
  for (int i = 0; i < kObserverSamples; ++i) {
    const float y = kObserverY[static_cast<std::size_t>(i)];
    sum += y * spectrum.at(360 + 5 * static_cast<float>(i));
    whole += y;
  }
  return sum / whole;
}

/// Returns an empty spectrum if the wavelengths are not in order; whoever reads the parameter reports that.
SpectralCurve of_pairs(const std::vector<float>& pairs) {
  SpectralCurve spectrum;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    spectrum.nm.push_back(pairs[i]);
    spectrum.values.push_back(pairs[i + 1]);
  }
  const bool in_order =
      std::adjacent_find(spectrum.nm.begin(), spectrum.nm.end(), std::greater_equal<float>()) == spectrum.nm.end();
  return in_order ? spectrum : SpectralCurve();
}

/// Leaves the hue in the parameter, and returns the strength that v4 takes away from it.
float take_light_strength(Edit& edit, const std::string& name) {
  const Param* const param = edit.find(name);
  const auto* values = param != nullptr ? std::get_if<std::vector<float>>(&param->values) : nullptr;
  if (param != nullptr && param->type == ParamType::spectrum && values == nullptr)
    edit.only_close("the strength of lights with spectra from files");
  if (values == nullptr) return 1;
  if (param->type == ParamType::spectrum) return luminance(of_pairs(*values));
  if (param->type != ParamType::blackbody || values->empty()) return 1;
  const float kelvin = values->front(), factor = values->size() > 1 ? (*values)[1] : 1;
  edit.set(ParamType::blackbody, name, std::vector{kelvin});
  const float strength = kelvin > 0 ? factor * luminance(blackbody(kelvin)) : 0;
  return std::isfinite(strength) ? strength : 0;
}

bool is_grey(const Rgb& c) { return c.r == c.g && c.g == c.b; }

/// Splits v3's scale, which is a colour; v4's is a number.
void scale_light(Edit& edit, const std::string& colour) {
  const float strength = take_light_strength(edit, colour);
  const bool has_map = edit.find("filename") != nullptr;
  Rgb factor = edit.constant("scale").value_or(Rgb(1)) * strength;
  edit.take("scale");
  const auto own = edit.constant(colour);
  if (has_map) {
    factor *= own.value_or(Rgb(1));
    edit.take(colour);
  } else if (!is_grey(factor) && (own || edit.find(colour) == nullptr)) {
    edit.set_rgb(colour, own.value_or(Rgb(1)) * factor);
    factor = Rgb(1);
  }
  if (!is_grey(factor)) {
    edit.only_close("light with a map, or a spectrum, and a colour as scale");
    factor = Rgb(mean(factor));
  }
  if (factor.r != 1) edit.set_number("scale", factor.r);
}

/// Turns v3's goniometric maps, whose pole is at +y, to dspm's +z: y and z change places.
void stand_upright(Edit& edit) {
  edit.set(ParamType::text, "mapping", std::vector<std::string>{"equirectangular"});
  Directive exchange = edit.make("ConcatTransform", {});
  exchange.numbers = {1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
  edit.before(edit.make("TransformBegin", {}));
  edit.before(std::move(exchange));
  edit.after(edit.make("TransformEnd", {}));
}

}  // namespace

void translate_light(Edit& edit) {
  const std::string from = edit.type();
  const auto* rule =
      std::find_if(std::begin(kLights), std::end(kLights), [&](const Rule& each) { return each.from == from; });
  if (rule == std::end(kLights)) return;
  edit.apply(*rule);
  const bool has_intensity = rule->words.starts_with("I");
  scale_light(edit, has_intensity ? "I" : "L");
  // v3's maps are of latitude and longitude; v4 knows only the octahedral ones, dspm both.
  if (from == "infinite" && edit.find("filename") != nullptr)
    edit.set(ParamType::text, "mapping", std::vector<std::string>{"equirectangular"});
  if (from == "spot") edit.only_close("spot (its penumbra)");
  if (from == "goniometric" && edit.find("filename") != nullptr) stand_upright(edit);
}

void translate_medium(Edit& edit) {
  if (edit.type() == "heterogeneous") edit.set_type("uniformgrid");
}

}  // namespace dspm::v3
