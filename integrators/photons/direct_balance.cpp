#include "dspm/integrators/photons/direct_balance.h"

#include <cmath>

#include "dspm/base/math/sampling.h"
#include "dspm/integrators/photons/hit_point.h"

namespace dspm {
namespace {

/// Returns the state of the light whose density photons of `state` are drawn with.
const Light& drawn_as(const SceneLight& light, const Light& state) {
  for (const SceneLight::Alike& alike : light.alike) {
    if (!alike.factors.empty()) continue;  // states that differ by a colour are drawn with equal densities
    for (const auto& other : alike.states)
      if (other.object.get() == &state) return *alike.first;
  }
  return state;
}

}  // namespace

DirectBalance::DirectBalance(const Scene& scene, const DirectWays& ways)
    : scene_(scene),
      guides_(ways.guides),
      photons_times_area_(kernel_size(ways.radius * ways.radius, static_cast<float>(ways.photons))),
      photons_a_ray_(ways.photons_a_ray),
      scatters_(ways.scatters || !scene.infinite_lights.empty()) {}

// With so many photons, rays could hardly improve on them: none is traced.
bool DirectBalance::Densities::enough_photons() const {
  constexpr float kEnough = 8;
  return !(photons < kEnough * (samples + scattered));
}

float DirectBalance::weight_of_photon(const SceneLight& light, const Light& state, const LightStart& start,
                                      const Place& place) const {
  if (light.glow.medium != kNoMedium) return 1;
  const Densities d = densities(light, state, start, place, pdf_w_of(state, start, place.p));
  return d.enough_photons() ? 1 : d.photons / d.all();
}

float DirectBalance::weight_of_sample(const LightSample& sample, const Place& place) const {
  const Densities d =
      densities(sample.scene_light, sample.light, start_of(sample.lit, place.p), place, sample.lit.pdf_w);
  return d.enough_photons() ? 0 : d.samples / d.all();
}

float DirectBalance::weight_of_scattered(const SceneLight& light, const Light& state, const LightStart& start,
                                         const Place& place) const {
  const Densities d = densities(light, state, start, place, pdf_w_of(state, start, place.p));
  return d.enough_photons() ? 0 : d.scattered / d.all();
}

// Photons arrive with the density of their starts times cos / distance^2 by area, or without the square from infinitely
// far away; the solid angle of a light's surface is its area times cos / distance^2.
DirectBalance::Densities DirectBalance::densities(const SceneLight& light, const Light& state, const LightStart& start,
                                                  const Place& place, float sample_pdf_w) const {
  const float cosine = std::abs(dot(place.ng, start.ray.direction)),
              samples = light_samples(scene_, light, {place.p, place.ng});
  Densities d{0, photons_a_ray_ * samples, 0};
  if (!light.is_delta) {
    d.samples *= sample_pdf_w;
    if (scatters_) d.scattered = photons_a_ray_ * cosine_hemisphere_pdf_w(cosine);
  }
  // Photons of such a light would only blur its shadows, and leak below walls that are thinner than a gather's radius.
  if (photons_times_area_ == 0 || is_told_by_a_ray(scene_, light)) return d;
  const Light& drawn = drawn_as(light, state);
  const EmissionPdf pdf = drawn.pdf_emit(start.ray, start.normal, start.primitive);
  d.photons = photons_times_area_ *
              start_density(guides_, scene_, light, drawn, start.ray, start.normal, start.primitive) * pdf.position *
              pdf.direction * cosine;
  if (light.is_delta && !pdf.delta_direction)
    d.photons /= length2(place.p - start.ray.origin);
  else if (!light.is_delta && !state.is_infinite())
    d.photons /= std::abs(dot(start.normal, start.ray.direction));
  return d;
}

}  // namespace dspm
