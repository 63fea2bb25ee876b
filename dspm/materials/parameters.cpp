// Reads the parameters that several materials share.
#include "dspm/materials/parameters.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/colour/rgb.h"
#include "dspm/math/vec.h"

namespace dspm {

Roughness::Roughness(ParamReader& reader, const MaterialContext& context) {
  const auto read = [&](std::string_view name, float fallback, std::string_view sentence) {
    const auto roughness = reader.number_or_texture(name, fallback, "", sentence);
    if (roughness.value < 0)
      reader.error(name, fmt::format("parameter \"{}\" of {} must not be negative", name, reader.subject()));
    return roughness;
  };
  const auto both = read("roughness", 0, "of the surface in both directions; 0 is smooth");
  const auto one = [&](std::string_view name, std::string_view sentence) {
    const auto own = read(name, std::max(both.value, 0.f), sentence);
    return texture_of(reader.has(name) ? own : both, context.textures, reader.diagnostics());
  };
  u_ = one("uroughness", "along the first tangent; the same as roughness if not given");
  v_ = one("vroughness", "across the first tangent; the same as roughness if not given");
  remap_ = reader.flag("remaproughness", true, "alpha is the square root of roughness, else roughness itself");
}

Vec2 Roughness::alpha(const SurfacePoint& point) const {
  const TexturePoint place = texture_point(point);
  const Vec2 roughness{u_->evaluate(place), v_->evaluate(place)};
  return remap_ ? Vec2{roughness_to_alpha(roughness.x), roughness_to_alpha(roughness.y)} : roughness;
}

float read_eta(ParamReader& reader, float fallback) {
  const Rgb eta = reader.rgb("eta", Rgb(fallback), SpectrumRole::unbounded, "index of refraction inside over outside");
  const float mean = (eta.r + eta.g + eta.b) / 3;
  if (!(mean > 0)) {
    reader.error("eta", "parameter \"eta\" of " + reader.subject() + " must be above 0");
    return fallback;
  }
  if (eta.r != eta.g || eta.g != eta.b)
    reader.diagnostics().note(reader.where("eta"),
                              fmt::format("dispersion is not supported: eta is {:.4g}, the mean of its colours", mean));
  return mean;
}

}  // namespace dspm
