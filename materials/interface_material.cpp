// interface: a surface that is not there, such as the boundary of a medium; its shapes are left out of the scene.
//
//   Material "interface"
//
// pbrt's older names "" and "none" mean the same. An area light on such a shape is left out as well, with a warning, as
// in pbrt. As a part of a mix it is a hole.
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/material.h"

namespace dspm {
namespace {

/// Lets light go straight on, for shapes that are looked at by themselves.
class StraightOn final : public Bsdf {
 public:
  LobeSet lobes(float least_alpha) const override { return least_alpha <= 0 ? 1 : 0; }
  Spectrum evaluate(const Vec3&, const Vec3&, Transport, LobeSet) const override { return {}; }
  float pdf_w(const Vec3&, const Vec3&, Transport, LobeSet) const override { return 0; }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3&, Transport, LobeSet lobes) const override {
    if (!(lobes & 1)) return std::nullopt;
    return BsdfSample{-wo, Spectrum(1), 0, true};
  }
  float lobe_probability(const Vec3&, LobeSet lobes) const override { return lobes & 1 ? 1.f : 0.f; }
};

class InterfaceMaterial final : public Material {
 public:
  const Bsdf& bsdf(const SurfacePoint&, BsdfSlot& slot) const override { return slot.emplace<StraightOn>(); }
  bool is_seen() const override { return false; }
};

}  // namespace

std::unique_ptr<Material> make_interface(ParamReader& reader, const MaterialContext&) {
  reader.finish();
  return std::make_unique<InterfaceMaterial>();
}

}  // namespace dspm
