// coatedconductor: metal under a clear coat, such as lacquered brass or metallic paint.
//
//   Material "coatedconductor" "float conductor.roughness" 0.1 "float interface.roughness" 0.001
//
//   interface.eta           float or spectrum   1.5         index of refraction of the coat over outside
//   interface.roughness     float texture       0           of the coat's surface; also .uroughness and .vroughness
//   conductor.eta, .k       spectrum texture    metal-Cu-*  complex index of refraction of the metal
//   reflectance             spectrum texture    none        of the metal at normal incidence, instead of both
//   conductor.roughness     float texture       0           of the metal; also .uroughness and .vroughness
//   remaproughness          bool                true        alpha is sqrt(roughness), else roughness itself
//   energycompensation      bool                true        false in .pbrt files: see below
//   g, albedo                                   0           of a medium in the coat; only 0 is supported
//   thickness, maxdepth, nsamples               0.01, 10, 1 of pbrt's random walk: thickness absorbs
//
// Both sides are coated. The coat mirrors (smooth, or GGX), and refracts as if it were smooth. With o' and i' the
// directions in the coat and R the metal's reflectance for light in the coat,
//   f = F-mirror or GGX + g GGX(o', i') R / eta^2,   g = (1 - F(o)) (1 - F(i)) / (1 - R sqrt(F(o) F(i))),
// where g counts what goes to and fro on the mirror's way, and is at most 1 - F(o) and 1 - F(i). What white metal would
// lose (light that is totally reflected in the coat, or meets a second facet) leaves as a diffuse lobe, coloured by two
// or more reflections. A rough coat widens the metal's lobe: to first order, a facet of slope s turns refracted light
// by (1 - 1/eta) s and mirrored light by 2 s. White metal gives back all light. Without energycompensation
// there is no diffuse lobe, and exp(-thickness / cos) is lost on each way through the coat, as in pbrt's walk. That
// keeps a little of what is totally reflected, and loses what is left at maxdepth, which is small.
// [Kulla and Conty 2017; Belcour 2018, Efficient Rendering of Layered Materials]
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/coat.h"
#include "dspm/materials/facet_albedo.h"
#include "dspm/materials/made_once.h"
#include "dspm/materials/made_up.h"
#include "dspm/materials/material.h"
#include "dspm/materials/microfacet.h"
#include "dspm/materials/parameters.h"
#include "dspm/materials/shading_frame.h"
#include "dspm/materials/small_number.h"

namespace dspm {
namespace {

constexpr LobeSet kCoat = 1, kMetal = 2, kMadeUp = 4;

/// Returns g, see above.
float passed_twice(float mirrored_o, float mirrored_i, float metal) {
  const float both = (1 - mirrored_o) * (1 - mirrored_i) / (1 - metal * std::sqrt(mirrored_o * mirrored_i));
  return std::min({both, 1 - mirrored_o, 1 - mirrored_i});
}

/// The properties that all points share.
struct CoatedMetal {
  Coat coat;
  float mirrored_mean;  // of diffuse light from outside, by a smooth coat
  std::shared_ptr<const AlbedoTable> rough_coat;
  std::shared_ptr<const AlbedoTable> by_way;  // of white metal under the coat, by its cosine outside and its alpha
  bool makes_up;

  /// Returns the direction in the coat, on the same side of the surface; nullopt if nothing gets in from there.
  std::optional<Vec3> inside(const Vec3& w) const {
    const float cos2 = 1 - (1 - w.z * w.z) / (coat.eta * coat.eta);
    return cos2 > 0 ? std::optional(Vec3{w.x / coat.eta, w.y / coat.eta, std::sqrt(cos2)}) : std::nullopt;
  }
  float mirrored(float cos) const { return fresnel_dielectric(cos, coat.eta); }
  /// Returns what white metal loses besides what the coat and the metal mirror. coat_alpha is 0 for a smooth coat.
  float lost(float cos, float alpha, float coat_alpha) const {
    return std::max(0.f,
                    1 - (coat_alpha > 0 ? rough_coat->of(cos, coat_alpha) : mirrored(cos)) - by_way->of(cos, alpha));
  }
  float lost_mean(float alpha, float coat_alpha) const {
    return std::max(0.f, 1 - (coat_alpha > 0 ? rough_coat->mean(coat_alpha) : mirrored_mean) - by_way->mean(alpha));
  }
};

std::shared_ptr<const AlbedoTable> metal_under_coat(float eta) {
  static MadeOnce<AlbedoTable> tables;
  return tables.of(eta, [](float index) {
    const CoatedMetal smooth{{index}, 0, nullptr, nullptr, true};
    return AlbedoTable([&](float cos, float alpha) {
      const auto o = smooth.inside(direction_of_cosine(cos));
      if (!o) return 0.f;
      const Ggx facets({alpha, alpha});
      return mean_over_facets(facets, *o, [&](const Vec3& m) {
        const Vec3 i = reflect(*o, m);
        const float cos2 = 1 - (1 - i.z * i.z) * index * index;
        if (i.z <= 0 || cos2 <= 0) return 0.f;
        return passed_twice(smooth.mirrored(cos), smooth.mirrored(std::sqrt(cos2)), 1) * facets.visible_after(*o, i);
      });
    });
  });
}

std::shared_ptr<const AlbedoTable> mirrored_by_rough_coat(float eta) {
  static MadeOnce<AlbedoTable> tables;
  return tables.of(eta, [](float index) {
    return AlbedoTable([&](float cos, float alpha) { return reflected_by_boundary(cos, alpha, index); });
  });
}

class CoatedConductor final : public Bsdf {
 public:
  CoatedConductor(const ShadingFrame& frame, const CoatedMetal& shared, const MetalIndex& index, Vec2 coat, Vec2 metal)
      : frame_(frame),
        shared_(&shared),
        index_{index.eta / shared.coat.eta, index.k / shared.coat.eta},
        coat_{SmallNumber(coat.x), SmallNumber(coat.y)},
        metal_{SmallNumber(metal.x), SmallNumber(metal.y)} {}

  LobeSet lobes(float least_alpha) const override {
    const auto if_rough = [&](LobeSet lobe, bool smooth, const Ggx& facets) {
      return (smooth ? 0 : facets.least_alpha()) >= std::max(least_alpha, 0.f) ? lobe : LobeSet{0};
    };
    const LobeSet made_up = shared_->makes_up ? kMadeUp : LobeSet{0};
    const LobeSet rest = is_mirror() ? 0 : static_cast<LobeSet>(made_up | if_rough(kMetal, false, metal()));
    return if_rough(kCoat, is_coat_smooth(), coat()) | rest;
  }

  Spectrum evaluate(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    return w.reflection() ? f(w.wo, w.wi, lobes) : Spectrum(0);
  }
  float pdf_w(const Vec3& wo, const Vec3& wi, Transport transport, LobeSet lobes) const override {
    const LocalPair w(frame_, wo, wi, transport);
    return w.reflection() ? w.share * density(w.wo, w.wi, chances(w.wo.z, lobes)) : 0;
  }
  float lobe_probability(const Vec3& wo, LobeSet lobes) const override {
    const auto all = chances(std::abs(frame_.local(wo, frame_.side(wo)).z), this->lobes(0));
    return (lobes & kCoat ? all[0] : 0) + (lobes & kMetal ? all[1] : 0) + (lobes & kMadeUp ? all[2] : 0);
  }

  std::optional<BsdfSample> sample(const Vec3& wo, const Vec3& u, Transport transport, LobeSet lobes) const override {
    const float side = frame_.side(wo);
    const auto arriving = frame_.arrive(wo, side, transport);
    if (!arriving || !(lobes & this->lobes(0))) return std::nullopt;
    const Vec3 o = *arriving;
    const Chances chance = chances(o.z, lobes);
    const bool mirrors = u.z < chance[0] && is_coat_smooth();
    const std::optional<Vec3> i = mirrors           ? std::optional(Vec3{-o.x, -o.y, o.z})
                                  : u.z < chance[0] ? std::optional(reflect(o, coat().sample_visible(o, u.x, u.y)))
                                  : u.z < chance[0] + chance[1] ? by_metal(o, u)
                                                                : std::optional(cosine_hemisphere({u.x, u.y}));
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

  Ggx coat() const { return Ggx({coat_[0], coat_[1]}); }
  Ggx metal() const { return Ggx({metal_[0], metal_[1]}); }
  bool is_coat_smooth() const { return Ggx::is_smooth({coat_[0], coat_[1]}); }
  bool is_mirror() const { return is_coat_smooth() && Ggx::is_smooth({metal_[0], metal_[1]}); }
  float metal_alpha() const { return Coat::mean_alpha(metal()); }
  float coat_alpha() const { return is_coat_smooth() ? 0 : Coat::mean_alpha(coat()); }

  Chances chances(float cos_o, LobeSet lobes) const {
    constexpr float kLeast = 1e-4f;
    const LobeSet known = lobes & this->lobes(0);
    Chances chances{shared_->mirrored(cos_o), shared_->by_way->of(cos_o, metal_alpha()),
                    shared_->lost(cos_o, metal_alpha(), coat_alpha())};
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
  Spectrum mirrored(const Vec3& o) const {
    const float coat = shared_->mirrored(o.z);
    const auto inside = is_mirror() ? shared_->inside(o) : std::nullopt;
    if (!inside) return Spectrum(coat);
    const float left = shared_->coat.left(inside->z), through = (1 - coat) * (1 - coat) * left * left;
    const Spectrum metal = fresnel_conductor(inside->z, index_.eta, index_.k);
    Spectrum sum;
    for (int c = 0; c < 3; ++c) sum[c] = coat + through * metal[c] / (1 - coat * metal[c] * left * left);
    return sum;
  }

  std::optional<Vec3> by_metal(const Vec3& o, const Vec3& u) const {
    const auto in = shared_->inside(o);
    if (!in) return std::nullopt;
    const Vec3 i = reflect(*in, metal().sample_visible(*in, u.x, u.y));
    const float eta = shared_->coat.eta, cos2 = 1 - (1 - i.z * i.z) * eta * eta;
    if (i.z <= 0 || cos2 <= 0) return std::nullopt;
    return Vec3{i.x * eta, i.y * eta, std::sqrt(cos2)};
  }

  Spectrum f(const Vec3& o, const Vec3& i, LobeSet lobes) const {
    Spectrum sum;
    const float mirrored_o = shared_->mirrored(o.z), mirrored_i = shared_->mirrored(i.z);
    if ((lobes & kCoat) && !is_coat_smooth()) {
      const Vec3 m = normalize(o + i);
      sum += Spectrum(shared_->coat.mirrored_by_facet(dot(o, m), o.z, i.z) * coat().reflection(o, i, m));
    }
    if (is_mirror()) return sum;
    const auto in = shared_->inside(o), out = shared_->inside(i);
    if ((lobes & kMetal) && in && out) {
      const Vec3 m = normalize(*in + *out);
      const Coat& coat = shared_->coat;
      const float facets =
          metal().reflection(*in, *out, m) * coat.left(in->z) * coat.left(out->z) / (coat.eta * coat.eta);
      const Spectrum metal = fresnel_conductor(dot(*in, m), index_.eta, index_.k);
      for (int c = 0; c < 3; ++c) sum[c] += passed_twice(mirrored_o, mirrored_i, metal[c]) * metal[c] * facets;
    }
    if (shared_->makes_up && (lobes & kMadeUp)) sum += made_up(o.z, i.z);
    return sum;
  }

  Spectrum made_up(float cos_o, float cos_i) const {
    const float alpha = metal_alpha(), lost = shared_->lost_mean(alpha, coat_alpha());
    const Spectrum metal = mean_fresnel_conductor(index_.eta, index_.k);
    const float leaves = std::min(1.f, shared_->by_way->mean(alpha) / (1 - shared_->mirrored_mean));
    return after_more_reflections(metal, leaves) *
           dspm::made_up(shared_->lost(cos_o, alpha, coat_alpha()), shared_->lost(cos_i, alpha, coat_alpha()), lost);
  }

  float density(const Vec3& o, const Vec3& i, const Chances& chances) const {
    float sum = chances[2] * i.z / kPi;
    if (!is_coat_smooth()) sum += chances[0] * coat().reflection_density(o, normalize(o + i));
    const auto in = shared_->inside(o), out = shared_->inside(i);
    if (chances[1] == 0 || !in || !out) return sum;
    const float eta = shared_->coat.eta, refracted = i.z / (eta * eta * out->z);
    return sum + chances[1] * metal().reflection_density(*in, normalize(*in + *out)) * refracted;
  }

  ShadingFrame frame_;
  const CoatedMetal* shared_;
  MetalIndex index_;                         // over that of the coat
  std::array<SmallNumber, 2> coat_, metal_;  // alpha along the tangent and across it
};

class CoatedConductorMaterial final : public Material {
 public:
  CoatedConductorMaterial(ParamReader& reader, const MaterialContext& context)
      : shared_{{read_eta(reader, 1.5f, "interface.eta")}, 0, nullptr, nullptr, true},
        remap_(Roughness::read_remap(reader)),
        interface_(reader, context, "interface.", remap_),
        metal_roughness_(reader, context, "conductor.", remap_),
        metal_(reader, context, "conductor.") {
    shared_.makes_up = read_energy_compensation(reader, context);
    const RandomWalk walk = read_random_walk(reader, !shared_.makes_up);
    if (!shared_.makes_up) shared_.coat.thickness = walk.thickness;
  }
  /// Call this after the parameters have been checked.
  void make_table() {
    shared_.by_way = metal_under_coat(shared_.coat.eta);
    shared_.rough_coat = mirrored_by_rough_coat(shared_.coat.eta);
    shared_.mirrored_mean = mean_fresnel_outside(shared_.coat.eta);
  }

  const Bsdf& bsdf(const SurfacePoint& point, BsdfSlot& slot) const override {
    const Vec2 coat = interface_.alpha(point), metal = metal_roughness_.alpha(point);
    // The slope of metal that turns light as the coat does on both ways.
    const float turns = (1 - 1 / shared_.coat.eta) / 2;
    const auto widened = [&](float a, float by) { return std::sqrt(a * a + 2 * turns * turns * by * by); };
    return slot.emplace<CoatedConductor>(ShadingFrame(point), shared_, metal_.index(point), coat,
                                         Vec2{widened(metal.x, coat.x), widened(metal.y, coat.y)});
  }

 private:
  CoatedMetal shared_;
  bool remap_;
  Roughness interface_, metal_roughness_;
  MetalLook metal_;
};

}  // namespace

std::unique_ptr<Material> make_coatedconductor(ParamReader& reader, const MaterialContext& context) {
  auto material = std::make_unique<CoatedConductorMaterial>(reader, context);
  reader.finish();
  material->make_table();
  return material;
}

}  // namespace dspm
