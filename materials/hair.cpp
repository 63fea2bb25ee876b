// hair: fibres that light is mirrored by, passes through, and is mirrored in, such as hair and fur; for curves.
//
//   Material "hair" "float eumelanin" 0.3
//
//   sigma_a       spectrum texture                 absorption per radius of the fibre
//   reflectance   spectrum texture                 or: the colour of dense hair; `color` means the same
//   eumelanin     float texture                    or: concentration of the brown pigment; 1.3 if nothing is given
//   pheomelanin   float texture                    and of the red one
//   eta           float texture            1.55    index of refraction of the fibre over outside, at least 1
//   beta_m        float texture            0.3     roughness along the fibre, 0.01 to 1
//   beta_n        float texture            0.3     roughness around it, 0.01 to 1
//   alpha         float texture            2       tilt of the scales on the fibre (degrees)
//
// The place across the fibre at which a ray meets it is that of the texture coordinate v: h = 2 v - 1. f is MAN /
// |cos(wi)| as in pbrt, where M scatters along, N around the fibre and A is what each path through it leaves, for the
// ray of `wo`.
//
// A photon path meets the fibre from where its light comes. A curve turns to each ray, so a unit of its length shows
// the camera cos(theta_o) of its width and takes cos(theta_i) of the light: f for flux is MAN of the way back, times
// cos(theta_o) / (cos(theta_i) |cos(wi)|). On other surfaces it is f for radiance the other way round, as usual. Light does
// not tell where it leaves the fibre; the way back is taken to be met at the mirrored place, so f for flux turns around
// the fibre the other way, which nobody sees in a fibre thinner than a pixel.
//
// [Chiang, Bitterli, Tappan, Burley 2016, A Practical and Controllable Hair and Fur Model for Production Path Tracing]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/fibre.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"

namespace dspm {
namespace {

struct FibreLook {
  Spectrum sigma_a;
  float h, eta, v, s;  // v, s: variance along, scale around
  float sin_tilt, cos_tilt;
};

class Hair final : public Bsdf {
 public:
  Hair(const SurfacePoint& point, const FibreLook& look)
      : along_(Basis::around(point.ns, point.dpdu).x), ns_(point.ns), ng_(point.ng), look_(look), turns_(point.turns) {}

  /// Fibres are not gathered on: they are too thin, and light goes through them.
  LobeSet lobes(float least_alpha) const override { return least_alpha < 1 ? 1 : 0; }
  bool transmits(LobeSet lobes) const override { return (lobes & 1) != 0; }
  float lobe_probability(const Vec3&, LobeSet lobes) const override { return lobes & 1 ? 1.f : 0.f; }

  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    if (!(lobes & 1) || !arrives(wo, wi, transport)) return {};
    if (transport == Transport::radiance) return scattered(Outgoing(*this, wo, look_.h), wi).flux / cosine(wi);
    return scattered(Outgoing(*this, wi, look_.h), wo).flux * flux_factor(wo, wi);
  }

  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    if (!(lobes & 1) || !arrives(wo, wi, transport)) return 0;
    return scattered(Outgoing(*this, wo, h_for(transport)), wi).density;
  }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    if (!(lobes & 1)) return std::nullopt;
    const Outgoing out(*this, wo, h_for(transport));
    const Vec3 wi = sampled(out, u);
    if (!arrives(wo, wi, transport)) return std::nullopt;
    const Scattered radiance = scattered(out, wi);
    if (!(radiance.density > 0)) return std::nullopt;
    const Spectrum weight = transport == Transport::radiance
                                ? radiance.flux
                                : scattered(Outgoing(*this, wi, look_.h), wo).flux * (flux_factor(wo, wi) * cosine(wi));
    return BsdfSample{wi, weight / radiance.density, radiance.density, false};
  }

 private:
  /// A direction by its angles along and around the fibre.
  struct Angles {
    float sin, cos, phi;
    Angles(const Hair& hair, const Vec3& w)
        : sin(std::clamp(dot(w, hair.along_), -1.f, 1.f)),
          cos(cos_of(sin)),
          phi(rounded::atan2(dot(w, hair.ns_), dot(w, cross(hair.ns_, hair.along_)))) {}
  };

  /// A ray that leaves: its passage of the fibre, and the chance with which each path is sampled.
  struct Outgoing {
    Angles w;
    FibrePassage passage;
    ByFibrePath<float> chance;
    ByFibrePath<Vec2> tilted;  // sin and cos of theta, tilted by the scales

    Outgoing(const Hair& hair, const Vec3& direction, float h)
        : w(hair, direction), passage(w.sin, w.cos, h, hair.look_.eta, hair.look_.sigma_a) {
      float sum = 0;
      for (std::size_t p = 0; p <= kFibrePaths; ++p) {
        const Spectrum& a = passage.attenuation[p];
        sum += chance[p] = mean(a);
      }
      for (float& c : chance) c /= sum;
      const float s = hair.look_.sin_tilt, c = hair.look_.cos_tilt;
      const Vec2 twice{2 * s * c, c * c - s * s}, four{2 * twice.x * twice.y, twice.y * twice.y - twice.x * twice.x};
      tilted = {turned({-twice.x, twice.y}), turned({s, c}), turned(four), Vec2{w.sin, w.cos}};
    }
    /// Returns w turned by an angle that is given by sine and cosine.
    Vec2 turned(Vec2 by) const { return {w.sin * by.y + w.cos * by.x, std::abs(w.cos * by.y - w.sin * by.x)}; }
  };

  struct Scattered {
    Spectrum flux;  // MAN
    float density;  // by solid angle, of sampling
  };

  float h_for(Transport transport) const { return transport == Transport::radiance ? look_.h : -look_.h; }
  float cosine(const Vec3& w) const { return std::abs(dot(w, ns_)); }

  /// Returns whether light comes from a side about which the normals agree, and goes to one.
  bool arrives(const Vec3& wo, const Vec3& wi, Transport transport) const {
    const Vec3& light = transport == Transport::radiance ? wi : wo;
    return dot(light, ng_) * dot(light, ns_) > 0 && dot(wi, ns_) != 0 && dot(wo, ns_) != 0;
  }

  float flux_factor(const Vec3& wo, const Vec3& wi) const {
    if (!turns_) return 1 / cosine(wo);
    const float cos_wo = Angles(*this, wo).cos, cos_wi = Angles(*this, wi).cos;
    return cos_wo > 0 ? cos_wi / (cos_wo * cosine(wi)) : 0;
  }

  /// Returns the variance of path p.
  float variance(std::size_t p) const { return look_.v * (p == 0 ? 1.f : p == 1 ? 0.25f : 4.f); }

  Scattered scattered(const Outgoing& out, const Vec3& wi) const {
    const Angles in(*this, wi);
    const Azimuthal around(look_.s);
    const Longitudinal along[] = {Longitudinal(variance(0)), Longitudinal(variance(1)), Longitudinal(variance(2))};
    Scattered sum{};
    for (std::size_t p = 0; p <= kFibrePaths; ++p) {
      const float m = along[std::min<std::size_t>(p, 2)].density(out.tilted[p].x, out.tilted[p].y, in.sin, in.cos);
      const float n =
          p == kFibrePaths ? 1 / (2 * kPi) : around.density(in.phi - out.w.phi - out.passage.turn(static_cast<int>(p)));
      sum.flux += out.passage.attenuation[p] * (m * n);
      sum.density += out.chance[p] * (m * n);
    }
    return sum;
  }

  Vec3 sampled(const Outgoing& out, const Vec3& u) const {
    std::size_t p = 0;
    float rest = u.z;
    while (p < kFibrePaths && rest >= out.chance[p]) rest -= out.chance[p++];
    rest = std::clamp(rest / out.chance[p], 0.f, 1 - 0x1p-24f);
    const float sin = Longitudinal(variance(p)).sample(out.tilted[p].x, out.tilted[p].y, {u.x, u.y}), cos = cos_of(sin);
    const float turn =
        p == kFibrePaths ? 2 * kPi * rest : out.passage.turn(static_cast<int>(p)) + Azimuthal(look_.s).sample(rest);
    const float phi = out.w.phi + turn;
    const rounded::SinCos around = rounded::sin_cos(phi);
    return along_ * sin + cross(ns_, along_) * (cos * around.cos) + ns_ * (cos * around.sin);
  }

  Vec3 along_, ns_, ng_;
  FibreLook look_;
  bool turns_;
};

/// The absorption of the pigments, for a concentration of 1.
constexpr Rgb kEumelanin{0.419f, 0.697f, 1.37f}, kPheomelanin{0.187f, 0.4f, 1.05f};

/// Returns the absorption that makes dense hair of that colour, as Chiang et al. fitted it.
Spectrum absorption_of(const Spectrum& colour, float beta_n) {
  constexpr float kDarkest = 1e-5f;
  const float fit =
      5.969f + beta_n * (-0.215f + beta_n * (2.532f + beta_n * (-10.73f + beta_n * (5.574f + beta_n * 0.245f))));
  Spectrum sigma;
  for (int c = 0; c < 3; ++c) {
    const float root = rounded::log(std::clamp(colour[c], kDarkest, 1.f)) / fit;
    sigma[c] = root * root;
  }
  return sigma;
}

float variance_of(float beta_m) {
  const float root = 0.726f * beta_m + 0.812f * beta_m * beta_m + 3.7f * rounded::pow(beta_m, 20.f);
  return root * root;
}
float scale_of(float beta_n) {
  constexpr float kRootOfPiOver8 = 0.626657069f;
  return kRootOfPiOver8 * (0.265f * beta_n + 1.194f * beta_n * beta_n + 5.372f * rounded::pow(beta_n, 22.f));
}

class HairMaterial final : public Material {
 public:
  HairMaterial(ParamReader& reader, const MaterialContext& context);

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const TexturePoint at = texture_point(point);
    const float beta_m = std::clamp(beta_m_->evaluate(at), kSmoothest, 1.f),
                beta_n = std::clamp(beta_n_->evaluate(at), kSmoothest, 1.f), tilt = alpha_->evaluate(at) * (kPi / 180);
    return slot.emplace<Hair>(point, FibreLook{sigma_a(at, beta_n), std::clamp(2 * point.uv.y - 1, -1.f, 1.f),
                                               std::max(eta_->evaluate(at), kLeastEta), variance_of(beta_m),
                                               scale_of(beta_n), rounded::sin(tilt), rounded::cos(tilt)});
  }

 private:
  static constexpr float kSmoothest = 0.01f, kLeastEta = 1;

  Spectrum sigma_a(const TexturePoint& at, float beta_n) const {
    if (sigma_a_) return map(sigma_a_->carried(at), [](float sigma) { return std::max(sigma, 0.f); });
    if (reflectance_) return absorption_of(reflectance_->carried(at), beta_n);
    return at.palette->carried(kEumelanin * std::max(0.f, eumelanin_->evaluate(at)) +
                               kPheomelanin * std::max(0.f, pheomelanin_->evaluate(at)));
  }

  TexturePtr<Rgb> sigma_a_, reflectance_;  // the first that is not null counts, else the pigments
  TexturePtr<float> eumelanin_, pheomelanin_, eta_, beta_m_, beta_n_, alpha_;
};

HairMaterial::HairMaterial(ParamReader& reader, const MaterialContext& context) {
  reader.alias("color", "reflectance");
  const auto sigma_a = reader.rgb_or_texture("sigma_a", Rgb(0), SpectrumRole::unbounded,
                                             "absorption per radius of the fibre; comes before the other colours"),
             reflectance = reader.rgb_or_texture("reflectance", Rgb(0.5f), SpectrumRole::albedo,
                                                 "or: the colour of dense hair; comes before the pigments");
  constexpr float kBrown = 1.3f;
  const auto numbers = [&](std::string_view name, float fallback, std::string_view unit, std::string_view sentence) {
    return texture_of(reader.number_or_texture(name, fallback, unit, sentence), context.textures, reader.diagnostics());
  };
  const float brown = reader.has("pheomelanin") ? 0 : kBrown;
  eumelanin_ = numbers("eumelanin", brown, "", "or: concentration of the brown pigment; 1.3 if nothing is given");
  pheomelanin_ = numbers("pheomelanin", 0, "", "concentration of the red pigment");
  eta_ = numbers("eta", 1.55f, "", "index of refraction of the fibre over outside, at least 1");
  if (const auto eta = eta_->constant(); eta && !(*eta >= kLeastEta))
    reader.error("eta", "parameter \"eta\" of " + reader.subject() + " must be at least 1");
  beta_m_ = numbers("beta_m", 0.3f, "", "roughness along the fibre, from 0.01 to 1");
  beta_n_ = numbers("beta_n", 0.3f, "", "roughness around the fibre, from 0.01 to 1");
  alpha_ = numbers("alpha", 2, "degrees", "tilt of the scales on the fibre");
  const std::string first = reader.has("sigma_a") ? "sigma_a" : reader.has("reflectance") ? "reflectance" : "";
  for (const char* name : {"reflectance", "eumelanin", "pheomelanin"})
    if (!first.empty() && first != name && reader.has(name))
      reader.warning(name, fmt::format("\"{}\" has no effect beside \"{}\"", name, first));
  if (reader.has("sigma_a"))
    sigma_a_ = texture_of(sigma_a, context.textures, reader.diagnostics());
  else if (reader.has("reflectance"))
    reflectance_ = texture_of(reflectance, context.textures, reader.diagnostics());
}

}  // namespace

std::unique_ptr<Material> make_hair(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<HairMaterial>(reader, context);
  reader.finish();
  return material;
}

}  // namespace dspm
