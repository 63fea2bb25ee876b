// diffuse: matte, of equal radiance in all directions; both sides.
//
//   Material "diffuse" "rgb reflectance" [.7 .68 .65]
//
//   reflectance   spectrum texture   0.5   share of the light that is reflected, clamped to 0..1
//
// [Lambert 1760, Photometria]
#include "core/sampling.h"
#include "materials/material.h"
#include "materials/parameters.h"

namespace dspm {
namespace {

class Diffuse final : public Bsdf {
 public:
  Diffuse(const SurfacePoint& point, const Rgb& f) : ng_(point.ng), ns_(point.ns), f_(f) {}

  LobeSet lobes(float) const override { return 1; }
  Rgb evaluate(const Vec3& wo, const Vec3& wi, Transport, LobeSet lobes) const override {
    return (lobes & 1) && cosine(wo, wi) > 0 ? f_ : Rgb(0);
  }
  float pdf_w(const Vec3& wo, const Vec3& wi, Transport, LobeSet lobes) const override {
    return lobes & 1 ? std::max(0.f, cosine(wo, wi)) / kPi : 0;
  }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport, LobeSet lobes) const override {
    if (!(lobes & 1)) return std::nullopt;
    const float side = dot(wo, ng_) > 0 ? 1.f : -1.f;
    const Vec3 local = cosine_hemisphere({u.x, u.y}), wi = Basis::around(ns_ * side).to_world(local);
    if (local.z <= 0 || dot(wi, ng_) * side <= 0) return std::nullopt;
    return BsdfSample{wi, f_ * kPi, local.z / kPi, false};
  }
  float share(const Vec3&, LobeSet lobes) const override { return lobes & 1 ? 1.f : 0.f; }
  std::optional<Rgb> lambertian(LobeSet lobes) const override { return lobes & 1 ? f_ : Rgb(0); }

 private:
  /// Between wi and ns, turned to wo's side; 0 where wi is on the other side of the surface.
  float cosine(const Vec3& wo, const Vec3& wi) const {
    const float side = dot(wo, ng_);
    return side * dot(wi, ng_) > 0 ? std::copysign(1.f, side) * dot(wi, ns_) : 0;
  }

  Vec3 ng_, ns_;
  Rgb f_;
};

class DiffuseMaterial final : public Material {
 public:
  explicit DiffuseMaterial(TexturePtr<Rgb> reflectance) : reflectance_(std::move(reflectance)) {}
  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    return slot.emplace<Diffuse>(point, clamped_albedo(reflectance_->evaluate(texture_point(point))) / kPi);
  }

 private:
  TexturePtr<Rgb> reflectance_;
};

}  // namespace

std::unique_ptr<Material> make_diffuse(ParamReader& reader, const MaterialContext& context) {
  const auto reflectance =
      reader.rgb_or_texture("reflectance", Rgb(0.5f), SpectrumRole::albedo, "share of the light that is reflected");
  refuse_unbuilt_parameters(reader);
  reader.finish();
  return std::make_unique<DiffuseMaterial>(texture_of(reflectance, context.textures, reader.diagnostics()));
}

}  // namespace dspm
