// diffusetransmission: matte on both sides and through, such as paper, a leaf or a lampshade of cloth.
//
//   Material "diffusetransmission" "rgb reflectance" [.3 .3 .25] "rgb transmittance" [.4 .35 .2]
//
//   reflectance     spectrum texture   0.25   fraction of the light that is reflected
//   transmittance   spectrum texture   0.25   fraction that leaves on the other side
//   scale           float              1      multiplies both
//
// Both are clamped to 0..1; where they add up to more than 1, they are scaled down to that.
#include <algorithm>
#include <cmath>
#include <typeinfo>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"

namespace dspm {
namespace {

// As in Diffuse, light is weighted by its cosine to ns, and photon paths sample around ng.
class DiffuseTransmission final : public Bsdf {
 public:
  DiffuseTransmission(const SurfacePoint& point, const Spectrum& reflectance, const Spectrum& transmittance)
      : ng_(point.ng), ns_(point.ns), reflected_(reflectance / kPi), transmitted_(transmittance / kPi) {
    const float r = max_component(reflectance), t = max_component(transmittance);
    chance_ = r + t > 0 ? r / (r + t) : 1;
  }

  LobeSet lobes(float) const override { return 1; }
  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    if (!(lobes & 1) || !faces(transport == Transport::radiance ? wi : wo)) return {};
    return dot(wo, ng_) * dot(wi, ng_) > 0 ? reflected_ : transmitted_;
  }
  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    if (!(lobes & 1) || (transport == Transport::flux && !faces(wo))) return 0;
    const bool is_reflected = dot(wo, ng_) * dot(wi, ng_) > 0;
    const float side = dot(wi, ng_) > 0 ? 1.f : -1.f;
    return (is_reflected ? chance_ : 1 - chance_) * std::max(0.f, side * dot(wi, axis(transport))) / kPi;
  }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    if (!(lobes & 1) || (transport == Transport::flux && !faces(wo))) return std::nullopt;
    const bool is_reflected = u.z < chance_;
    const float side = (dot(wo, ng_) > 0) == is_reflected ? 1.f : -1.f;
    const Vec3 local = cosine_hemisphere({u.x, u.y}), wi = Basis::around(axis(transport) * side).to_world(local);
    if (local.z <= 0 || dot(wi, ng_) * side <= 0) return std::nullopt;
    const float cosines = axis(transport) == ns_ ? 1 : std::abs(dot(wi, ns_)) / local.z;
    const float chance = is_reflected ? chance_ : 1 - chance_;
    const Spectrum& f = is_reflected ? reflected_ : transmitted_;
    return BsdfSample{wi, f * (kPi * cosines / chance), chance * local.z / kPi, false};
  }
  float lobe_probability(const Vec3&, LobeSet lobes) const override { return lobes & 1 ? 1.f : 0.f; }
  bool transmits(LobeSet lobes) const override { return (lobes & 1) && !is_black(transmitted_); }
  std::optional<Spectrum> ratio_to(const Bsdf& other, LobeSet) const override {
    if (typeid(other) != typeid(DiffuseTransmission)) return std::nullopt;
    const auto& o = static_cast<const DiffuseTransmission&>(other);
    const auto by_reflection = ratio(reflected_, o.reflected_), by_transmission = ratio(transmitted_, o.transmitted_);
    return by_reflection == by_transmission ? by_reflection : std::nullopt;
  }

 private:
  /// Returns whether both normals have `w` on the same side.
  bool faces(const Vec3& w) const { return dot(w, ng_) * dot(w, ns_) > 0; }
  const Vec3& axis(Transport transport) const { return transport == Transport::radiance ? ns_ : ng_; }

  Vec3 ng_, ns_;
  Spectrum reflected_, transmitted_;  // f
  float chance_;                      // the probability that reflection is sampled
};

class DiffuseTransmissionMaterial final : public Material {
 public:
  DiffuseTransmissionMaterial(TexturePtr<Rgb> reflectance, TexturePtr<Rgb> transmittance, float scale)
      : reflectance_(std::move(reflectance)),
        transmittance_(std::move(transmittance)),
        scale_(scale),
        is_linear_(reflectance_->averages() && transmittance_->averages() &&
                   scale_ * (most(*reflectance_) + most(*transmittance_)) <= 1) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const TexturePoint at = texture_point(point);
    const Spectrum reflectance = clamped_albedo(reflectance_->carried(at) * scale_),
                   transmittance = clamped_albedo(transmittance_->carried(at) * scale_);
    const Spectrum both = reflectance + transmittance;
    const Spectrum share = map(both, [](float sum) { return 1 / std::max(1.f, sum); });
    return slot.emplace<DiffuseTransmission>(point, reflectance * share, transmittance * share);
  }
  bool is_linear() const override { return is_linear_; }

 private:
  /// Returns the most that a texture of albedos may have.
  static float most(const Texture<Rgb>& albedo) { return max_component(albedo.constant().value_or(Rgb(1))); }

  TexturePtr<Rgb> reflectance_, transmittance_;
  float scale_;
  bool is_linear_;  // nothing is scaled down anywhere
};

}  // namespace

std::unique_ptr<Material> make_diffusetransmission(ParamReader& reader, const MaterialContext& context) {
  const auto reflectance = reader.rgb_or_texture("reflectance", Rgb(0.25f), SpectrumRole::albedo,
                                                 "fraction of the light that is reflected"),
             transmittance = reader.rgb_or_texture("transmittance", Rgb(0.25f), SpectrumRole::albedo,
                                                   "fraction of the light that leaves on the other side");
  const float scale = reader.number("scale", 1, "", "multiplies both");
  if (!(scale >= 0)) reader.error("scale", "\"scale\" must not be negative");
  reader.finish();
  return std::make_unique<DiffuseTransmissionMaterial>(
      texture_of(reflectance, context.textures, reader.diagnostics()),
      texture_of(transmittance, context.textures, reader.diagnostics()), scale);
}

}  // namespace dspm
