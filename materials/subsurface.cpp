// subsurface: a body of which light sees the inside, such as milk, wax, marble or skin.
//
//   Material "subsurface" "string name" "Skin1" "float scale" 1
//   Material "subsurface" "rgb reflectance" [.9 .6 .4] "rgb mfp" [.2 .1 .05]
//
//   name               string              none        a measured medium, per millimetre: "Wholemilk", "Marble", ...
//   sigma_a, sigma_s   spectrum textures   Wholemilk   absorption and scattering, per unit of length
//   reflectance        spectrum texture    none        of a thick body for the light that gets in, instead of these
//   mfp                spectrum texture    1           with it: the mean length between collisions
//   scale              float               1           multiplies sigma_a and sigma_s, or mfp
//   g                  float               0           mean cosine of a collision; with a name, 0
//   eta                float or spectrum   1.33        index of refraction of the body over outside
//   roughness          float texture       0           of the surface's mirror, in both directions
//   uroughness         float texture       roughness   along the first tangent
//   vroughness         float texture       roughness   across it
//   remaproughness     bool                true        alpha is sqrt(roughness), else roughness itself
//
// The surface mirrors a part F(w) of the light, smooth or as GGX. The rest crosses it and is diffused by it, both ways.
// Inside, light walks from collision to collision (walk.h). Where it meets the surface again, it is thrown
// back, diffusely, with the probability r = 1 - T / eta^2, where T is the mean of 1 - F over diffuse light from
// outside; else it leaves in the directions (1 - F(w)) cos(w) / (pi T). This is reciprocal and loses nothing, and
// photons can be gathered where light crosses the surface. As the walk sees the body's real shape, thin parts shine
// through, which pbrt's profile for a flat thick body leaves out. Nothing else should be inside the body, and its mesh
// should be closed. Where it overlaps glass, its "priority" must be the higher one: light that enters it by the glass's
// surface would not be scattered.
//
// Of diffuse light, a thick body returns the share R = (1 - s)(1 - 0.139 s) / (1 + 1.17 s), with s^2 = (1 - albedo) /
// (1 - g albedo) [van de Hulst 1980, Multiple Light Scattering]. Thrown back by the surface again and again, R (1 - r)
// / (1 - r R) leaves: this is the `reflectance`, from which the albedo is found by solving both equations. It holds to
// 1.5% for g = 0, and to 5% for g = 0.5.
#include <algorithm>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/interface.h"
#include "dspm/materials/material.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/per_surroundings.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/media/measured_media.h"

namespace dspm {
namespace {

/// The surface mirrors; what it does not mirror crosses it.
constexpr LobeSet kMirror = kReflection, kBody = kTransmission;

/// The properties that are the same everywhere on a body.
struct Boundary {
  Boundary(float index, float mean_cosine)
      : eta(index), g(mean_cosine), let_in(std::max(1e-4f, 1 - mean_fresnel_outside(index))) {}
  float eta, g, let_in;
  float thrown_back() const { return std::max(0.f, 1 - let_in / (eta * eta)); }
  float crosses(float cos_outside) const { return 1 - fresnel_dielectric(cos_outside, eta); }
};

class Subsurface final : public Bsdf {
 public:
  Subsurface(const ShadingFrame& frame, Vec2 alpha, const Boundary& boundary, const Spectrum& sigma_t,
             const Spectrum& albedo)
      : frame_(frame), facets_(alpha), boundary_(&boundary), sigma_t_(sigma_t), albedo_(albedo) {}

  LobeSet lobes(float least_alpha) const override {
    return (is_smooth() ? 0 : facets_.least_alpha()) >= std::max(least_alpha, 0.f) ? kBothLobes : kBody;
  }
  bool transmits(LobeSet lobes) const override { return (lobes & kBody) != 0; }
  bool enters(const Vec3& w) const override { return frame_.side(w) < 0; }

  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    return w.valid ? Spectrum(f(w, transport, lobes)) : Spectrum(0);
  }

  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    return w.valid ? density(w, lobes) : 0;
  }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!(lobes & kBothLobes) || !arriving) return std::nullopt;
    const Vec3 o = *arriving;
    const float mirrored = chance_of_mirror(o.z, side, lobes);
    if (u.z < mirrored) return mirror(wo, o, u, transport, lobes, mirrored);
    if (!(lobes & kBody)) return std::nullopt;
    const Vec3 i = cosine_hemisphere({u.x, u.y});
    if (i.z <= 0) return std::nullopt;
    return drawn(wo, {i.x, i.y, -i.z}, u, side, transport, lobes);
  }

  float lobe_probability(const Vec3& wo, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    return share_of(chance_of_mirror(std::abs(frame_.local(wo, side).z), side, kBothLobes), lobes);
  }

 private:
  bool is_smooth() const {
    const Vec2 alpha = facets_.alpha();
    return std::max(alpha.x, alpha.y) <= Ggx::kSmoothest || boundary_->eta == 1;
  }

  /// Returns the probability of mirroring; light that arrives from inside leaves.
  float chance_of_mirror(float cos_o, float side, LobeSet lobes) const {
    return side > 0 ? chance_of_reflection(1 - boundary_->crosses(cos_o), lobes) : 0;
  }

  std::optional<BsdfSample> mirror(const Vec3& wo, const Vec3& o, const Vec3& u, Transport transport, LobeSet lobes,
                                   float chance) const {
    if (!is_smooth()) {
      const Vec3 i = reflect(o, facets_.sample_visible(o, u.x, u.y));
      return i.z > 0 ? drawn(wo, i, u, 1, transport, lobes) : std::nullopt;
    }
    const auto leaving = frame_.leave({-o.x, -o.y, o.z}, 1, transport, u.x);
    if (!leaving) return std::nullopt;
    return BsdfSample{leaving->wi, Spectrum((1 - boundary_->crosses(o.z)) / (chance * leaving->share)), 0, true};
  }

  /// Returns a sample with a density, in the direction i.
  std::optional<BsdfSample> drawn(const Vec3& wo, const Vec3& i, const Vec3& u, float side, Transport transport,
                                  LobeSet lobes) const {
    const auto leaving = frame_.leave(i, side, transport, u.x);
    if (!leaving) return std::nullopt;
    const LocalPair w(frame_, wo, leaving->wi, transport);
    if (!w.valid) return std::nullopt;
    const float pdf = density(w, lobes);
    BsdfSample sample{leaving->wi, Spectrum(f(w, transport, lobes) * std::abs(w.wi.z) / pdf), pdf, false};
    if (w.wi.z > 0) return sample;
    const bool inside = side > 0;
    if (transport == Transport::radiance) sample.eta_scale = inside ? 1 / boundary_->let_in : boundary_->let_in;
    sample.ahead = inside ? Interior{sigma_t_, albedo_, boundary_->g, boundary_->thrown_back()} : Interior{};
    return sample;
  }

  /// Returns f. For flux, light that crosses from outside is spread over all directions inside, and light from inside
  /// leaves in the directions in which light would enter. For radiance, directions are exchanged.
  float f(const LocalPair& w, Transport transport, LobeSet lobes) const {
    const bool outside = w.side > 0;
    if (w.wi.z < 0) {
      if (!(lobes & kBody)) return 0;
      const float cos_outside = outside ? w.wo.z : -w.wi.z;
      const bool enters = outside == (transport == Transport::flux);  // light comes from outside
      return boundary_->crosses(cos_outside) / (enters ? kPi : kPi * boundary_->let_in);
    }
    if (!outside || !(lobes & kMirror) || is_smooth()) return 0;
    const Vec3 m = normalize(w.wo + w.wi);
    // As for a coat: no more than a smooth surface mirrors of either direction.
    const float mirrored = 1 - boundary_->crosses(dot(w.wo, m));
    const float most = 1 - std::max(boundary_->crosses(w.wo.z), boundary_->crosses(w.wi.z));
    const bool bounded = boundary_->eta >= 1 && boundary_->eta <= 4;
    return (bounded ? mirrored : std::min(mirrored, most)) * facets_.reflection(w.wo, w.wi, m);
  }

  float density(const LocalPair& w, LobeSet lobes) const {
    const float mirrored = chance_of_mirror(w.wo.z, w.side, lobes);
    if (w.wi.z < 0) return lobes & kBody ? w.share * (1 - mirrored) * -w.wi.z / kPi : 0;
    if (w.side < 0 || !(lobes & kMirror) || is_smooth()) return 0;
    return w.share * mirrored * facets_.reflection_density(w.wo, normalize(w.wo + w.wi));
  }

  ShadingFrame frame_;
  Ggx facets_;
  const Boundary* boundary_;  // the material's
  Spectrum sigma_t_, albedo_;
};

float albedo_of_reflectance(float reflectance, const Boundary& boundary) {
  const float out = 1 - boundary.thrown_back(), target = std::clamp(reflectance, 0.f, 1.f);
  const float returned = target / (out + (1 - out) * target);
  // 0.139 s^2 - (1.139 + 1.17 R) s + 1 - R = 0
  const float b = 1.139f + 1.17f * returned, c = 1 - returned;
  const float s = 2 * c / (b + std::sqrt(std::max(0.f, b * b - 4 * 0.139f * c)));
  return std::clamp((1 - s * s) / (1 - boundary.g * s * s), 0.f, 1.f);
}

class SubsurfaceMaterial final : public Material {
 public:
  struct Textures {
    TexturePtr<Rgb> a, s;  // sigma_a and sigma_s, or reflectance and mfp
    bool by_reflectance;
  };

  SubsurfaceMaterial(float eta, float g, float scale, const Roughness& roughness, Textures textures)
      : boundary_([eta, g](float outside) { return Boundary(eta / outside, g); }),
        scale_(scale),
        roughness_(roughness),
        textures_(std::move(textures)) {}

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const TexturePoint at = texture_point(point);
    const Spectrum a = textures_.a->carried(at), s = textures_.s->carried(at);
    const Boundary& boundary = boundary_.of(point.outside_eta);
    Spectrum sigma_t, albedo;
    for (int c = 0; c < 3; ++c) {
      const float first = std::max(0.f, a[c]), second = std::max(0.f, scale_ * s[c]);
      if (textures_.by_reflectance) {
        sigma_t[c] = std::min(kDensest, 1 / second);
        albedo[c] = albedo_of_reflectance(first, boundary_.of(1));
      } else {
        sigma_t[c] = std::min(kDensest, scale_ * first + second);
        albedo[c] = sigma_t[c] > 0 ? second / (scale_ * first + second) : 0;
      }
    }
    return slot.emplace<Subsurface>(ShadingFrame(point), roughness_.alpha(point), boundary, sigma_t, albedo);
  }
  bool bounds_a_body() const override { return true; }
  float eta() const override { return boundary_.of(1).eta; }
  bool scatters_inside() const override { return true; }

 private:
  static constexpr float kDensest = 1e8f;

  PerSurroundings<Boundary> boundary_;
  float scale_;
  Roughness roughness_;
  Textures textures_;
};

TexturePtr<Rgb> constant(const float (&values)[3]) {
  return std::make_shared<ConstantTexture<Rgb>>(Rgb(values[0], values[1], values[2]));
}

/// The medium that fills the body, by any of pbrt's three ways to say it.
class Contents {
 public:
  explicit Contents(ParamReader& reader)
      : name_(reader.text("name", "", "a measured medium such as \"Skin1\", per millimetre")),
        sigma_a_(reader.rgb_or_texture("sigma_a", {.0011f, .0024f, .014f}, SpectrumRole::unbounded,
                                       "absorption per unit of length; the default is milk's, per millimetre")),
        sigma_s_(reader.rgb_or_texture("sigma_s", {2.55f, 3.21f, 3.77f}, SpectrumRole::unbounded,
                                       "scattering per unit of length; the default is milk's, per millimetre")),
        reflectance_(reader.rgb_or_texture("reflectance", Rgb(1), SpectrumRole::albedo,
                                           "of a thick body for the light that gets in, instead of sigma_a, sigma_s")),
        mfp_(reader.rgb_or_texture("mfp", Rgb(1), SpectrumRole::unbounded,
                                   "with reflectance: mean length between collisions")) {
    const bool sigma = reader.has("sigma_a") || reader.has("sigma_s"), reflectance = reader.has("reflectance");
    if (!name_.empty() + sigma + reflectance > 1)
      reader.error(reflectance ? "reflectance" : "sigma_a",
                   reader.subject() + " takes one of \"name\", \"sigma_a\" and \"sigma_s\", or \"reflectance\"");
    if (reader.has("sigma_a") != reader.has("sigma_s"))
      reader.error(reader.has("sigma_a") ? "sigma_a" : "sigma_s",
                   reader.subject() + " takes \"sigma_a\" and \"sigma_s\" together");
    if (reader.has("mfp") && !reflectance)
      reader.error("mfp", "\"mfp\" of " + reader.subject() + " needs a \"reflectance\"");
    by_reflectance_ = reflectance;
  }

  bool is_by_name() const { return !name_.empty(); }
  SubsurfaceMaterial::Textures textures(ParamReader& reader, const MaterialContext& context) const {
    if (!name_.empty())
      if (const MeasuredMedium* medium = find_measured_medium(reader, "name", name_))
        return {constant(medium->sigma_a), constant(medium->sigma_s), false};
    const auto texture = [&](const ValueOrTexture<Rgb>& value) {
      return texture_of(value, context.textures, reader.diagnostics());
    };
    return {texture(by_reflectance_ ? reflectance_ : sigma_a_), texture(by_reflectance_ ? mfp_ : sigma_s_),
            by_reflectance_};
  }

 private:
  std::string name_;
  ValueOrTexture<Rgb> sigma_a_, sigma_s_, reflectance_, mfp_;
  bool by_reflectance_ = false;
};

}  // namespace

std::unique_ptr<Material> make_subsurface(ParamReader& reader, const MaterialContext& context) {
  constexpr float kWater = 1.33f;
  const Contents contents(reader);
  const float scale = reader.number("scale", 1, "", "multiplies sigma_a and sigma_s, or mfp");
  float g = reader.number("g", 0, "", "mean cosine of a collision, between -1 and 1; with a name, 0");
  const float eta = read_eta(reader, kWater);
  const Roughness roughness(reader, context);
  reader.finish();
  if (!(scale > 0)) reader.error("scale", "\"scale\" of " + reader.subject() + " must be above 0");
  if (!(std::abs(g) < 1)) reader.error("g", "\"g\" of " + reader.subject() + " must be between -1 and 1");
  if (contents.is_by_name() && g != 0) {
    reader.warning("g", "\"g\" has no effect on a measured medium, whose scattering is given for g = 0");
    g = 0;
  }
  return std::make_unique<SubsurfaceMaterial>(eta, g, scale, roughness, contents.textures(reader, context));
}

}  // namespace dspm
