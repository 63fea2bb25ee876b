// Bsdfs as plain values, without virtual functions, which a device can have: nvcc makes no virtual function one for
// devices, constexpr or not, and an address of the CPU's functions is worth nothing there. BsdfOf makes a Bsdf of such a
// value. Beside each kind stands what a material says of it, once its textures are looked up: with_bsdf() calls a function
// of any Bsdf with the one that it is at a point.
#pragma once

#include <concepts>
#include <optional>
#include <typeinfo>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/bsdf.h"

namespace dspm {

/// What holds unless a class that derives from it says otherwise. Such a class also has lobes, evaluate, pdf_w, sample
/// and lobe_probability. All mean what they do in Bsdf.
struct PlainBsdf {
  constexpr bool transmits(LobeSet) const { return false; }
  constexpr bool disperses(const Vec3&, const Vec3&) const { return false; }
  constexpr std::optional<Spectrum> lambertian(LobeSet) const { return std::nullopt; }
  /// Takes a Bsdf of the same class.
  constexpr std::optional<Spectrum> ratio_to(const PlainBsdf& /*other*/, LobeSet) const { return std::nullopt; }
};

template <std::derived_from<PlainBsdf> Plain>
class BsdfOf final : public Bsdf {
 public:
  template <class... Args>
  explicit BsdfOf(const Args&... args) : plain_(args...) {}

  LobeSet lobes(float least_alpha) const override { return plain_.lobes(least_alpha); }
  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    return plain_.evaluate(wo, wi, transport, lobes);
  }
  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    return plain_.pdf_w(wo, wi, transport, lobes);
  }
  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    return plain_.sample(wo, u, transport, lobes);
  }
  float lobe_probability(const Vec3& wo, LobeSet lobes) const override { return plain_.lobe_probability(wo, lobes); }
  bool transmits(LobeSet lobes) const override { return plain_.transmits(lobes); }
  bool disperses(const Vec3& wo, const Vec3& wi) const override { return plain_.disperses(wo, wi); }
  std::optional<Spectrum> lambertian(LobeSet lobes) const override { return plain_.lambertian(lobes); }
  std::optional<Spectrum> ratio_to(const Bsdf& other, LobeSet lobes) const override {
    if (typeid(other) != typeid(BsdfOf)) return std::nullopt;
    return plain_.ratio_to(static_cast<const BsdfOf&>(other).plain_, lobes);
  }

 private:
  Plain plain_;
};

/// Puts the Bsdf that it is called with into a slot.
struct IntoSlot {
  BsdfSlot& slot;

  template <std::derived_from<PlainBsdf> Plain>
  const Bsdf& operator()(const Plain& plain) const {
    return slot.emplace<BsdfOf<Plain>>(plain);
  }
};

}  // namespace dspm
