// How a medium scatters, in the words of surfaces: f is the albedo times the phase function, and has no cosine.
#pragma once

#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/bsdf.h"
#include "dspm/media/henyey_greenstein.h"

namespace dspm {

class PhaseBsdf final : public Bsdf {
 public:
  PhaseBsdf(const Spectrum& albedo, const HenyeyGreenstein& phase) : albedo_(albedo), phase_(phase) {}

  LobeSet lobes(float) const override { return 1; }
  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport, LobeSet) const override {
    return albedo_ * phase_.pdf_w(-wo, wi);
  }
  float pdf_w(const Vec3& wo, const Vec3& wi, Transport, LobeSet) const override { return phase_.pdf_w(-wo, wi); }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport, LobeSet) const override {
    const Vec3 wi = phase_.sample(-wo, {u.x, u.y});
    return BsdfSample{wi, albedo_, phase_.pdf_w(-wo, wi), false};
  }
  float lobe_probability(const Vec3&, LobeSet) const override { return 1; }

 private:
  Spectrum albedo_;
  HenyeyGreenstein phase_;
};

}  // namespace dspm
