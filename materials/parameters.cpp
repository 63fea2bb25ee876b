// Reads the parameters that several materials share.
#include "dspm/materials/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/plain_parameters.h"
#include "dspm/textures/plain_part.h"
#include "dspm/textures/plain_value.h"

namespace dspm {

Roughness::Roughness(ParamReader& reader, const MaterialContext& context, const std::string& prefix, bool remap)
    : remap_(remap) {
  const auto read = [&](const std::string& name, float fallback, std::string_view sentence) {
    const auto roughness = reader.number_or_texture(name, fallback, "", sentence);
    if (roughness.value < 0)
      reader.error(name, fmt::format("parameter \"{}\" of {} must not be negative", name, reader.subject()));
    return roughness;
  };
  const auto both = read(prefix + "roughness", 0, "of the surface in both directions; 0 is smooth");
  const auto one = [&](const std::string& name, std::string_view sentence) {
    const auto own = read(name, std::max(both.value, 0.f), sentence);
    return texture_of(reader.has(name) ? own : both, context.textures, reader.diagnostics());
  };
  u_ = one(prefix + "uroughness", "along the first tangent; the same as roughness if not given");
  v_ = one(prefix + "vroughness", "across the first tangent; the same as roughness if not given");
  plain_u_ = std::make_shared<PlainPart<float>>(u_), plain_v_ = std::make_shared<PlainPart<float>>(v_);
}

bool Roughness::read_remap(ParamReader& reader) {
  return reader.flag("remaproughness", true, "alpha is the square root of roughness, else roughness itself");
}

Vec2 Roughness::alpha(const SurfacePoint& point) const { return here(point).alpha(place_of(point)); }

PlainRoughness Roughness::here(const SurfacePoint& point) const {
  const TexturePoint place = texture_point(point);
  return {{u_->evaluate(place)}, {v_->evaluate(place)}, remap_};
}

std::optional<PlainRoughness> Roughness::plain(const Palette& palette) const {
  const auto u = plain_u_->value(palette), v = plain_v_->value(palette);
  return u && v ? std::optional(PlainRoughness{*u, *v, remap_}) : std::nullopt;
}

bool read_energy_compensation(ParamReader& reader, const MaterialContext& context) {
  return reader.flag("energycompensation", !context.as_in_pbrt,
                     "light that meets several facets leaves, too; false: it is lost, as in pbrt and .pbrt files");
}

float read_eta(ParamReader& reader, float fallback, const std::string& name) {
  const Rgb eta = reader.rgb(name, Rgb(fallback), SpectrumRole::unbounded, "index of refraction inside over outside");
  const float mean = dspm::mean(eta);
  if (!(mean > 0)) {
    reader.error(name, fmt::format("parameter \"{}\" of {} must be above 0", name, reader.subject()));
    return fallback;
  }
  if (eta.r != eta.g || eta.g != eta.b)
    reader.diagnostics().note(
        reader.where(name),
        fmt::format("{} has no dispersion: {} is {:.4g}, the mean of its colours", reader.subject(), name, mean));
  return mean;
}

MetalLook::MetalLook(ParamReader& reader, const MaterialContext& context, const std::string& prefix) {
  const auto eta =
      reader.rgb_or_texture(prefix + "eta", "metal-Cu-eta", SpectrumRole::unbounded, "index of refraction");
  const auto k = reader.rgb_or_texture(prefix + "k", "metal-Cu-k", SpectrumRole::unbounded, "absorption coefficient");
  const auto reflectance = reader.rgb_or_texture("reflectance", Rgb(1), SpectrumRole::albedo,
                                                 "at normal incidence, instead of eta and k; unused if not given");
  by_reflectance_ = reader.has("reflectance");
  if (by_reflectance_ && (reader.has(prefix + "eta") || reader.has(prefix + "k")))
    reader.error("reflectance", fmt::format("{} takes either \"reflectance\" or \"{}eta\" and \"{}k\"",
                                            reader.subject(), prefix, prefix));
  eta_or_reflectance_ = texture_of(by_reflectance_ ? reflectance : eta, context.textures, reader.diagnostics());
  k_ = texture_of(k, context.textures, reader.diagnostics());
  plain_eta_or_reflectance_ = std::make_shared<PlainPart<Rgb>>(eta_or_reflectance_);
  plain_k_ = std::make_shared<PlainPart<Rgb>>(k_);
}

MetalIndex MetalLook::index(const SurfacePoint& point) const { return here(point).index(place_of(point)); }

PlainMetal MetalLook::here(const SurfacePoint& point) const {
  const TexturePoint place = texture_point(point);
  return {by_reflectance_, {eta_or_reflectance_->carried(place)}, {by_reflectance_ ? Spectrum(0) : k_->carried(place)}};
}

std::optional<PlainMetal> MetalLook::plain(const Palette& palette) const {
  const auto value = plain_eta_or_reflectance_->value(palette), k = plain_k_->value(palette);
  return value && k ? std::optional(PlainMetal{by_reflectance_, *value, *k}) : std::nullopt;
}

ValueOrTexture<float> read_opacity(ParamReader& reader) {
  return reader.number_or_texture("alpha", 1, "", "the fraction of rays that the surface stops; 0: a hole");
}

EmissionLook read_emission_look(ParamReader& reader) {
  const EmissionLook look{reader.rgb_or_texture("emission", Rgb(0), SpectrumRole::illuminant,
                                                "colour of the light that both sides of the surface emit"),
                          reader.number("emissionstrength", 1, "", "times emission: radiance")};
  if (!(look.strength >= 0))
    reader.error("emissionstrength", "parameter \"emissionstrength\" of " + reader.subject() + " must not be negative");
  return look;
}

Absorption::Absorption(ParamReader& reader)
    : colour_(reader.colour("attenuationcolor", Rgb(1), SpectrumRole::albedo,
                            "of white light after attenuationdistance in the body")) {
  const float distance = reader.number("attenuationdistance", 1, "world units", "after which it has attenuationcolor");
  if (distance > 0)
    distance_ = distance;
  else
    reader.error("attenuationdistance",
                 "parameter \"attenuationdistance\" of " + reader.subject() + " must be above 0");
  in_rgb_ = of(Palette::rgb().carried(colour_));
}

Spectrum Absorption::of(const Spectrum& left) const {
  constexpr float kDarkest = 1e-30f;
  return map(clamped_albedo(left), [&](float c) { return -rounded::log(std::max(c, kDarkest)) / distance_; });
}

std::optional<int> read_priority(ParamReader& reader) {
  const int priority = reader.integer("priority", 0, "", "of its body: where bodies overlap, the highest one is there");
  return reader.has("priority") ? std::optional(priority) : std::nullopt;
}

}  // namespace dspm
