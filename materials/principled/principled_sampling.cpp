// Samples the layers of the principled material, and computes the density of the samples.
#include <algorithm>
#include <cmath>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/principled/principled_layers.h"
#include "dspm/materials/rough_boundary.h"

namespace dspm {
namespace {

/// Limits what a dark base takes from what mirrors: it must not take all paths. It goes in steps, so that finishes that
/// are about equally bright choose alike and stay one path.
float weight_in_choice(float brightness) {
  return brightness >= 1 / 4.f ? 1 : brightness >= 1 / 16.f ? 1 / 4.f : 1 / 16.f;
}

}  // namespace

/// Counts colours in steps or not at all: frames of different colours then choose alike.
PrincipledChances PrincipledLayers::weights(const Way& o) const {
  const float cos_o = o.cos, left = o.left, over_glass = outside_ ? left : 1;
  const float metal = metal_ == 0 || smooth_ ? 1 : tables_.common.metal.of(cos_o, alpha_);
  const float dielectric = mirrored_by_dielectric(o, std::max(0.f, most_more_));
  float glass_mirrored = 0, glass = 1;
  if (glass_ > 0 && smooth_) glass_mirrored = film_ ? mean(glass_facet(cos_o, eta_)) : fresnel_dielectric(cos_o, eta());
  if (glass_ > 0 && !smooth_) {
    glass = (thin_ ? tables_.common.metal : boundary().reflected_or_refracted).of(cos_o, alpha_);
    glass_mirrored = std::min(glass, boundary().reflected.of(cos_o, alpha_));
  }
  glass_mirrored += (glass - glass_mirrored) * sent_back(cos_o, o, o);
  const float at_ground = opaque_ * (1 - dielectric) * left;
  const float ground = at_ground * (1 - beyond_) * weight_in_choice(max_component(base_)),
              beyond = at_ground * beyond_ * weight_in_choice(max_component(beyond_colour_));
  const float made_up = metal_ * (1 - metal) * left + glass_ * (1 - glass) * over_glass;
  const float of_sheen = sheen_weight_ > 0 ? covered_ * (1 - left_by_sheen(cos_o)) : 0;
  const float diffuse = ground + beyond + made_up + of_sheen;
  return {{(metal_ * metal + opaque_ * dielectric) * left + glass_ * glass_mirrored * over_glass,
           glass_ * (glass - glass_mirrored) * over_glass, diffuse,
           covered_ * mirrored_by_coat(o.coat) * left_by_sheen(cos_o)},
          diffuse > 0 ? beyond / diffuse : beyond_};
}

PrincipledChances PrincipledLayers::chances(const Vec3& o, Transport transport, LobeSet lobes) const {
  constexpr float kLeast = 1e-4f;  // no lobe that exists is left out where the tables round it to nothing
  const LobeSet known = lobes & this->lobes(0);
  PrincipledChances chances = weights(way(o, to_sample(o, transport)));
  float sum = 0;
  for (int lobe = 0; lobe < 4; ++lobe) {
    float& chance = chances.chance[static_cast<std::size_t>(lobe)];
    chance = known >> lobe & 1 ? std::max(chance, kLeast) : 0;
    sum += chance;
  }
  for (float& chance : chances.chance) chance = sum > 0 ? chance / sum : 0;
  return chances;
}

float PrincipledLayers::density(const Vec3& o, const Vec3& i, Transport transport,
                                const PrincipledChances& chances) const {
  if (i.z < 0) {
    const float diffuse = chances[2] * chances.beyond * -i.z / kPi;
    return diffuse + (smooth_ || chances[1] == 0 ? 0 : chances[1] * density_through(o, i));
  }
  float sum = chances[2] * (1 - chances.beyond) * i.z / kPi;
  const Tilts tilts = to_sample(o, transport);
  if (!smooth_ && chances[0] > 0)
    if (const Tilt::Pair w = tilts.facets.pair(o, i, transport); w.above)
      sum += chances[0] * facets_.reflection_density(w.o, w.m);
  if (!smooth_coat_ && chances[3] > 0)
    if (const Tilt::Pair w = tilts.coat.pair(o, i, transport); w.above)
      sum += chances[3] * coat_facets_.reflection_density(w.o, w.m);
  return sum;
}

std::optional<PrincipledLayers::Drawn> PrincipledLayers::draw(const Vec3& o, const Vec3& u, Transport transport,
                                                              const PrincipledChances& chances) const {
  const Tilts tilts = to_sample(o, transport);
  // Reflections first: then coupled frames whose lobes differ part as little as possible.
  float below = chances[3];
  if (u.z < below) return draw_coat(o, u, tilts, transport, chances[3]);
  below += chances[0];
  if (u.z < below) return draw_specular(o, u, tilts, transport, chances[0]);
  below += chances[1];
  if (u.z < below) return draw_through(o, u, chances[1]);
  if (chances[2] == 0) return std::nullopt;
  return draw_diffuse(u, (u.z - below) / chances[2], chances.beyond);
}

/// `of_lobe` is the number that chose the lobe, as a share of it.
std::optional<PrincipledLayers::Drawn> PrincipledLayers::draw_diffuse(const Vec3& u, float of_lobe,
                                                                      float beyond) const {
  const Vec3 i = cosine_hemisphere({u.x, u.y});
  if (!(i.z > 0)) return std::nullopt;
  return Drawn{of_lobe < 1 - beyond ? i : other_side(i), false};
}

std::optional<PrincipledLayers::Drawn> PrincipledLayers::draw_coat(const Vec3& o, const Vec3& u, const Tilts& tilts,
                                                                   Transport transport, float chance) const {
  const Vec3 seen = tilts.coat.seen(o);
  if (seen.z <= 0) return std::nullopt;
  const Vec3 m = smooth_coat_ ? Vec3{0, 0, 1} : coat_facets_.sample_visible(seen, u.x, u.y);
  const Vec3 mirrored = smooth_coat_ ? Vec3{-seen.x, -seen.y, seen.z} : reflect(seen, m);
  const Vec3 i = tilts.coat.back(mirrored);
  if (mirrored.z <= 0 || i.z <= 0) return std::nullopt;
  if (!smooth_coat_) return Drawn{i, false};
  const float passed = covered_ * coat_under_sheen(o.z) * coat_under_sheen(i.z) * coat_;
  return Drawn{
      i, true,
      Spectrum(passed * fresnel_dielectric(seen.z, kCoatEta) * tilts.coat.mirror_factor(o, i, transport) / chance)};
}

std::optional<PrincipledLayers::Drawn> PrincipledLayers::draw_specular(const Vec3& o, const Vec3& u, const Tilts& tilts,
                                                                       Transport transport, float chance) const {
  const Vec3 seen = tilts.facets.seen(o);
  if (seen.z <= 0) return std::nullopt;
  const Vec3 mirrored =
      smooth_ ? Vec3{-seen.x, -seen.y, seen.z} : reflect(seen, facets_.sample_visible(seen, u.x, u.y));
  const Vec3 i = tilts.facets.back(mirrored);
  if (mirrored.z <= 0 || i.z <= 0) return std::nullopt;
  if (!smooth_) return Drawn{i, false};
  const Spectrum f = mirrored_by_facet(seen.z, way(o, tilts), way(i, tilts));
  return Drawn{i, true, f * (tilts.facets.mirror_factor(o, i, transport) / chance)};
}

std::optional<PrincipledLayers::Drawn> PrincipledLayers::draw_through(const Vec3& o, const Vec3& u,
                                                                      float chance) const {
  const Vec3 m = smooth_ ? Vec3{0, 0, 1} : facets_.sample_visible(o, u.x, u.y);
  const auto i = thin_ ? std::optional(other_side(reflect(o, m))) : refract(o, m, eta());
  if (!i || i->z >= 0) return std::nullopt;
  if (!smooth_) return Drawn{*i, false, {}, !thin_};
  const Tilts tilts = as_they_are();
  return Drawn{*i, true, through_facet(o.z, way(o, tilts), way(*i, tilts)) / chance, !thin_};
}

}  // namespace dspm
