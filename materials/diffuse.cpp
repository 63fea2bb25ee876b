// diffuse: matte, with equal radiance in all directions; both sides.
//
//   Material "diffuse" "rgb reflectance" [.7 .68 .65]
//
//   reflectance   spectrum texture   0.5   fraction of the light that is reflected, clamped to 0..1
//
// [Lambert 1760, Photometria]
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/material.h"
#include "dspm/materials/parameters.h"

namespace dspm {
namespace {

// Light is weighted by its cosine to ns and leaves to the whole of its side of ng. So photon paths sample around ng: a
// lobe around ns would send nothing to directions that ns does not face.
class Diffuse final : public Bsdf {
 public:
  Diffuse(const SurfacePoint& point, const Spectrum& f) : ng_(point.ng), ns_(point.ns), f_(f) {}

  LobeSet lobes(float) const override { return 1; }
  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const bool one_side = dot(wo, ng_) * dot(wi, ng_) > 0;
    return (lobes & 1) && one_side && faces(transport == Transport::radiance ? wi : wo) ? f_ : Spectrum(0);
  }
  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const float side = dot(wo, ng_);
    if (!(lobes & 1) || !(side * dot(wi, ng_) > 0) || (transport == Transport::flux && !faces(wo))) return 0;
    return std::max(0.f, std::copysign(1.f, side) * dot(wi, axis(transport))) / kPi;
  }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    if (!(lobes & 1) || (transport == Transport::flux && !faces(wo))) return std::nullopt;
    const float side = dot(wo, ng_) > 0 ? 1.f : -1.f;
    const Vec3 local = cosine_hemisphere({u.x, u.y}), wi = Basis::around(axis(transport) * side).to_world(local);
    if (local.z <= 0 || dot(wi, ng_) * side <= 0) return std::nullopt;
    const float cosines = axis(transport) == ns_ ? 1 : std::abs(dot(wi, ns_)) / local.z;
    return BsdfSample{wi, f_ * (kPi * cosines), local.z / kPi, false};
  }
  float lobe_probability(const Vec3&, LobeSet lobes) const override { return lobes & 1 ? 1.f : 0.f; }
  std::optional<Spectrum> lambertian(LobeSet lobes) const override { return lobes & 1 ? f_ : Spectrum(0); }

 private:
  /// Returns whether both normals have `w` on the same side.
  bool faces(const Vec3& w) const { return dot(w, ng_) * dot(w, ns_) > 0; }
  const Vec3& axis(Transport transport) const { return transport == Transport::radiance ? ns_ : ng_; }

  Vec3 ng_, ns_;
  Spectrum f_;
};

class DiffuseMaterial final : public Material {
 public:
  explicit DiffuseMaterial(TexturePtr<Rgb> reflectance)
      : reflectance_(std::move(reflectance)), is_linear_(reflectance_->averages()) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return slot.emplace<Diffuse>(point, clamped_albedo(reflectance_->carried(texture_point(point))) / kPi);
  }
  bool is_linear() const override { return is_linear_; }

 private:
  TexturePtr<Rgb> reflectance_;
  bool is_linear_;
};

}  // namespace

std::unique_ptr<Material> make_diffuse(ParamReader& reader, const MaterialContext& context) {
  const auto reflectance =
      reader.rgb_or_texture("reflectance", Rgb(0.5f), SpectrumRole::albedo, "fraction of the light that is reflected");
  reader.finish();
  return std::make_unique<DiffuseMaterial>(texture_of(reflectance, context.textures, reader.diagnostics()));
}

}  // namespace dspm
