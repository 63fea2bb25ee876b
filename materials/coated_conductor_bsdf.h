// The scattering of metal under a clear coat, both smooth or of rough facets.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/albedo_table.h"
#include "dspm/materials/coat.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/made_up.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/plain_bsdf.h"
#include "dspm/materials/plain_parameters.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/materials/small_number.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

/// What all points of a coat over metal share. The tables must outlive it.
struct CoatOverMetal {
  Coat coat;
  float mirrored_mean = 0;  // of diffuse light from outside, by a smooth coat
  bool makes_up = true;
  const AlbedoTable* rough_coat = nullptr;
  const AlbedoTable* by_way = nullptr;  // of white metal under the coat, by its cosine outside and its alpha

  /// Returns the direction in the coat, on the same side of the surface; nullopt if nothing gets in from there.
  constexpr std::optional<Vec3> inside(const Vec3& w) const {
    const float cos2 = 1 - (1 - w.z * w.z) / (coat.eta * coat.eta);
    return cos2 > 0 ? std::optional<Vec3>(Vec3{w.x / coat.eta, w.y / coat.eta, rounded::sqrt(cos2)}) : std::nullopt;
  }
  /// Returns the direction outside of one in the coat; nullopt if it is totally reflected.
  constexpr std::optional<Vec3> outside(const Vec3& w) const {
    const float cos2 = 1 - (1 - w.z * w.z) * coat.eta * coat.eta;
    if (w.z <= 0 || cos2 <= 0) return std::nullopt;
    return Vec3{w.x * coat.eta, w.y * coat.eta, rounded::sqrt(cos2)};
  }
  /// Returns g: what goes through the coat twice and to and fro in it, on the mirror's way, if the metal mirrors that much.
  static constexpr float passed_twice(float mirrored_o, float mirrored_i, float metal) {
    const float both = (1 - mirrored_o) * (1 - mirrored_i) / (1 - metal * rounded::sqrt(mirrored_o * mirrored_i));
    return std::min(std::min(both, 1 - mirrored_o), 1 - mirrored_i);
  }
  /// Returns what white metal loses besides what the coat and the metal mirror. coat_alpha is 0 for a smooth coat.
  constexpr float lost(float cos, float alpha, float coat_alpha) const {
    const float mirrored = coat_alpha > 0 ? rough_coat->of(cos, coat_alpha) : coat.mirrored(cos);
    return std::max(0.f, 1 - mirrored - by_way->of(cos, alpha));
  }
  constexpr float lost_mean(float alpha, float coat_alpha) const {
    const float mirrored = coat_alpha > 0 ? rough_coat->mean(coat_alpha) : mirrored_mean;
    return std::max(0.f, 1 - mirrored - by_way->mean(alpha));
  }

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(rough_coat, 1);
    fn(by_way, 1);
  }
};

class CoatedConductor final : public PlainBsdf {
 public:
  static constexpr LobeSet kCoat = 1, kMetal = 2, kMadeUp = 4;

  /// Takes the alphas of the coat and of the metal.
  constexpr CoatedConductor(const ShadingFrame& frame, const CoatOverMetal& shared, const MetalIndex& index, Vec2 coat,
                            Vec2 metal)
      : frame_(frame),
        index_{index.eta / shared.coat.eta, index.k / shared.coat.eta},
        coat_{SmallNumber(coat.x), SmallNumber(coat.y)},
        metal_{SmallNumber(metal.x), SmallNumber(metal.y)},
        shared_(shared) {}

  constexpr LobeSet lobes(float least_alpha) const {
    const auto if_rough = [&](LobeSet lobe, bool smooth, const Ggx& facets) {
      return (smooth ? 0 : facets.least_alpha()) >= std::max(least_alpha, 0.f) ? lobe : LobeSet{0};
    };
    const LobeSet made_up = shared_.makes_up ? kMadeUp : LobeSet{0};
    const LobeSet rest = is_mirror() ? 0 : static_cast<LobeSet>(made_up | if_rough(kMetal, false, metal()));
    return if_rough(kCoat, is_coat_smooth(), coat()) | rest;
  }

  constexpr Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
    const LocalPair w(frame_, wo, wi, transport);
    return w.reflection() ? f(w.wo, w.wi, lobes) : Spectrum(0);
  }
  constexpr float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const {
    const LocalPair w(frame_, wo, wi, transport);
    return w.reflection() ? w.share * density(w.wo, w.wi, chances(w.wo.z, lobes)) : 0;
  }
  constexpr float lobe_probability(const Vec3& wo, LobeSet lobes) const {
    const auto all = chances(std::abs(frame_.local(wo, frame_.side(wo)).z), this->lobes(0));
    return (lobes & kCoat ? all[0] : 0) + (lobes & kMetal ? all[1] : 0) + (lobes & kMadeUp ? all[2] : 0);
  }

  constexpr std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const {
    const float side = frame_.side(wo);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!arriving || !(lobes & this->lobes(0))) return std::nullopt;
    const Vec3 o = *arriving;
    const Chances chance = chances(o.z, lobes);
    const bool mirrors = u.z < chance[0] && is_coat_smooth();
    const std::optional<Vec3> i = mirrors ? std::optional<Vec3>(Vec3{-o.x, -o.y, o.z})
                                  : u.z < chance[0]
                                      ? std::optional<Vec3>(reflect(o, coat().sample_visible(o, u.x, u.y)))
                                  : u.z < chance[0] + chance[1] ? by_metal(o, u)
                                                                : std::optional<Vec3>(cosine_hemisphere({u.x, u.y}));
    if (!i || i->z <= 0) return std::nullopt;
    const auto leaving = frame_.leave(*i, side, transport, u.x);
    if (!leaving) return std::nullopt;
    if (mirrors) return BsdfSample{leaving->wi, mirrored(o) / (chance[0] * leaving->share), 0, true};
    const float pdf = leaving->share * density(o, *i, chance);
    if (!(pdf > 0)) return std::nullopt;
    return BsdfSample{leaving->wi, f(o, *i, lobes) * (i->z / pdf), pdf, false};
  }

 private:
  using Chances = std::array<float, 3>;

  constexpr Ggx coat() const { return Ggx({coat_[0], coat_[1]}); }
  constexpr Ggx metal() const { return Ggx({metal_[0], metal_[1]}); }
  constexpr bool is_coat_smooth() const { return Ggx::is_smooth({coat_[0], coat_[1]}); }
  constexpr bool is_mirror() const { return is_coat_smooth() && Ggx::is_smooth({metal_[0], metal_[1]}); }
  constexpr float metal_alpha() const { return Coat::mean_alpha(metal()); }
  constexpr float coat_alpha() const { return is_coat_smooth() ? 0 : Coat::mean_alpha(coat()); }

  constexpr Chances chances(float cos_o, LobeSet lobes) const {
    constexpr float kLeast = 1e-4f;
    const LobeSet known = lobes & this->lobes(0);
    Chances chances{shared_.coat.mirrored(cos_o), shared_.by_way->of(cos_o, metal_alpha()),
                    shared_.lost(cos_o, metal_alpha(), coat_alpha())};
    float sum = 0;
    for (int lobe = 0; lobe < 3; ++lobe) {
      float& chance = chances[static_cast<std::size_t>(lobe)];
      chance = known >> lobe & 1 ? std::max(chance, kLeast) : 0;
      sum += chance;
    }
    for (float& chance : chances) chance = sum > 0 ? chance / sum : 0;
    return chances;
  }

  /// Returns what smooth metal mirrors under a smooth coat.
  constexpr Spectrum mirrored(const Vec3& o) const {
    const float coat = shared_.coat.mirrored(o.z);
    const auto inside = is_mirror() ? shared_.inside(o) : std::nullopt;
    if (!inside) return Spectrum(coat);
    const float left = shared_.coat.left(inside->z), through = (1 - coat) * (1 - coat) * left * left;
    const Spectrum metal = fresnel_conductor(inside->z, index_.eta, index_.k);
    Spectrum sum;
    for (int c = 0; c < 3; ++c) sum[c] = coat + through * metal[c] / (1 - coat * metal[c] * left * left);
    return sum;
  }

  constexpr std::optional<Vec3> by_metal(const Vec3& o, const Vec3& u) const {
    const auto in = shared_.inside(o);
    return in ? shared_.outside(reflect(*in, metal().sample_visible(*in, u.x, u.y))) : std::nullopt;
  }

  constexpr Spectrum f(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    Spectrum sum;
    const float mirrored_o = shared_.coat.mirrored(o.z), mirrored_i = shared_.coat.mirrored(i.z);
    if ((lobes & kCoat) && !is_coat_smooth()) {
      const Vec3 m = normalize(o + i);
      sum += Spectrum(shared_.coat.mirrored_by_facet(dot(o, m), o.z, i.z) * coat().reflection(o, i, m));
    }
    if (is_mirror()) return sum;
    const auto in = shared_.inside(o), out = shared_.inside(i);
    if ((lobes & kMetal) && in && out) {
      const Vec3 m = normalize(*in + *out);
      const Coat& coat = shared_.coat;
      const float facets =
          metal().reflection(*in, *out, m) * coat.left(in->z) * coat.left(out->z) / (coat.eta * coat.eta);
      const Spectrum metal = fresnel_conductor(dot(*in, m), index_.eta, index_.k);
      for (int c = 0; c < 3; ++c)
        sum[c] += CoatOverMetal::passed_twice(mirrored_o, mirrored_i, metal[c]) * metal[c] * facets;
    }
    if (shared_.makes_up && (lobes & kMadeUp)) sum += made_up(o.z, i.z);
    return sum;
  }

  constexpr Spectrum made_up(float cos_o, float cos_i) const {
    const float alpha = metal_alpha(), lost = shared_.lost_mean(alpha, coat_alpha());
    const Spectrum metal = mean_fresnel_conductor(index_.eta, index_.k);
    const float leaves = std::min(1.f, shared_.by_way->mean(alpha) / (1 - shared_.mirrored_mean));
    return after_more_reflections(metal, leaves) *
           dspm::made_up(shared_.lost(cos_o, alpha, coat_alpha()), shared_.lost(cos_i, alpha, coat_alpha()), lost);
  }

  constexpr float density(const Vec3& o, const Vec3& i, const Chances& chances) const {
    float sum = chances[2] * i.z / kPi;
    if (!is_coat_smooth()) sum += chances[0] * coat().reflection_density(o, normalize(o + i));
    const auto in = shared_.inside(o), out = shared_.inside(i);
    if (chances[1] == 0 || !in || !out) return sum;
    const float eta = shared_.coat.eta, refracted = i.z / (eta * eta * out->z);
    return sum + chances[1] * metal().reflection_density(*in, normalize(*in + *out)) * refracted;
  }

  ShadingFrame frame_;
  MetalIndex index_;                         // over that of the coat
  std::array<SmallNumber, 2> coat_, metal_;  // alpha along the tangent and across it
  CoatOverMetal shared_;
};

/// The tables must outlive it.
struct PlainCoatedConductor {
  PlainRoughness coat_roughness, metal_roughness;
  PlainMetal metal;
  CoatOverMetal shared;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    coat_roughness.each_array(fn);
    metal_roughness.each_array(fn);
    metal.each_array(fn);
    shared.each_array(fn);
  }

  template <class Fn>
  constexpr decltype(auto) with_bsdf(const SurfaceGeometry& point, const Fn& fn) const {
    const PlainPlace place = place_of(point);
    const Vec2 coat = coat_roughness.alpha(place), alpha = metal_roughness.alpha(place);
    // The slope of metal that turns light as the coat does on both ways.
    const float turns = (1 - 1 / shared.coat.eta) / 2;
    const auto widened = [&](float a, float by) { return rounded::sqrt(a * a + 2 * turns * turns * by * by); };
    return fn(CoatedConductor(ShadingFrame(point), shared, metal.index(place), coat,
                              Vec2{widened(alpha.x, coat.x), widened(alpha.y, coat.y)}));
  }
};

}  // namespace dspm
