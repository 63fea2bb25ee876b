// Material "velvet" "rgb reflectance" [.3 .02 .05] "rgb rim" [.9 .4 .5] "float falloff" 4
//
// Cloth of upright fibres: dark from above, with a bright rim. With g(w) = (1 - cos w)^falloff and N = (falloff + 1)
// (falloff + 2) / 2,
//
//   f(wo, wi) = [ reflectance (1 - rim g(wo)) (1 - rim g(wi)) + rim N g(wo) g(wi) ] / pi.
//
// N makes the second term reflect the fraction rim g(wo) of the light: 2 N times the integral of (1 - c)^falloff c over
// [0, 1] is 1. So no more light comes back than came in, and f is reciprocal.
//
//   reflectance  spectrum texture  0.5   fraction of the light that the ground reflects
//   rim          spectrum texture  0.5   fraction that the fibres reflect at grazing angles
//   falloff      float             4     how narrow the rim is; 1 to 64
#include <dspm/base/math/sampling.h>
#include <dspm/materials/parameters.h>
#include <dspm/materials/shading_frame.h>
#include <dspm/session/modules/module.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace dspm;

class Velvet final : public Bsdf {
 public:
  Velvet(const SurfacePoint& point, const Spectrum& ground, const Spectrum& rim, float falloff)
      : frame_(point), ground_(ground), rim_(rim), falloff_(falloff) {}

  LobeSet lobes(float) const override { return 1; }

  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair pair(frame_, wo, wi, transport);
    return (lobes & 1) && pair.reflection() ? f(pair.wo.z, pair.wi.z) : Spectrum(0);
  }

  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair pair(frame_, wo, wi, transport);
    return (lobes & 1) && pair.reflection() ? pair.share * density(pair.wo.z, pair.wi.z) : 0;
  }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & 1) || !arriving) return std::nullopt;
    const float cos_o = arriving->z;
    const Vec2 place{u.x, u.y};
    const Vec3 local = u.z < rim_chance(cos_o) ? uniform_hemisphere(place) : cosine_hemisphere(place);
    const auto leaving = frame_.leave(local, side, transport, u.x);
    if (!leaving) return std::nullopt;
    const float pdf_w = leaving->share * density(cos_o, local.z);
    return BsdfSample{leaving->wi, f(cos_o, local.z) * (local.z / pdf_w), pdf_w, false};
  }

  float lobe_probability(const Vec3&, LobeSet lobes) const override { return lobes & 1 ? 1.f : 0.f; }

 private:
  float grazing(float cosine) const { return std::pow(std::max(0.f, 1 - cosine), falloff_); }

  Spectrum f(float cos_o, float cos_i) const {
    const float g_o = grazing(cos_o), g_i = grazing(cos_i), n = (falloff_ + 1) * (falloff_ + 2) / 2;
    return (ground_ * (Spectrum(1) - rim_ * g_o) * (Spectrum(1) - rim_ * g_i) + rim_ * (n * g_o * g_i)) / kPi;
  }

  /// Of sampling the whole hemisphere uniformly, as suits the rim.
  float rim_chance(float cos_o) const {
    const float rim = max_component(rim_) * grazing(cos_o), ground = max_component(ground_) * (1 - rim);
    return rim + ground > 0 ? rim / (rim + ground) : 0;
  }
  float density(float cos_o, float cos_i) const {
    const float chance = rim_chance(cos_o);
    return chance * kUniformHemispherePdfW + (1 - chance) * cosine_hemisphere_pdf_w(cos_i);
  }

  ShadingFrame frame_;
  Spectrum ground_, rim_;
  float falloff_;
};

class VelvetMaterial final : public Material {
 public:
  VelvetMaterial(TexturePtr<Rgb> ground, TexturePtr<Rgb> rim, float falloff)
      : ground_(std::move(ground)), rim_(std::move(rim)), falloff_(falloff) {}

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const TexturePoint at = texture_point(point);
    return slot.emplace<Velvet>(point, clamped_albedo(ground_->carried(at)), clamped_albedo(rim_->carried(at)),
                                falloff_);
  }

 private:
  TexturePtr<Rgb> ground_, rim_;
  float falloff_;
};

std::unique_ptr<Material> make_velvet(ParamReader& reader, const MaterialContext& context) {
  const auto ground = reader.rgb_or_texture("reflectance", Rgb(0.5f), SpectrumRole::albedo,
                                            "fraction of the light that the ground reflects");
  const auto rim = reader.rgb_or_texture("rim", Rgb(0.5f), SpectrumRole::albedo,
                                         "fraction that the fibres reflect at grazing angles");
  const float falloff = reader.number("falloff", 4, "", "how narrow the rim is; 1 to 64");
  if (!(falloff >= 1 && falloff <= 64)) reader.error("falloff", "the falloff must be between 1 and 64");
  reader.finish();
  return std::make_unique<VelvetMaterial>(texture_of(ground, context.textures, reader.diagnostics()),
                                          texture_of(rim, context.textures, reader.diagnostics()), falloff);
}

}  // namespace

DSPM_MODULE(registry) {
  registry.add(material_plugins(), {"velvet", "cloth that is dark from above and bright at its rim", make_velvet});
}
