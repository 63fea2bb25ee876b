// The densities of a light's two ways to start a path, of photons and of shadow rays, on one measure.
#pragma once

#include <cmath>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/methods/vcm/subpath_weights.h"
#include "dspm/integrators/methods/vcm/vcm_pass.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns whether the light's own vertex is a direction rather than a point, so that densities do not fall with the
/// distance.
inline bool is_parallel(const Light& light, const EmissionPdf& pdf) {
  return light.is_infinite() || pdf.delta_direction;
}

/// Returns the density of choosing the light, the start and the direction of a light subpath; 0 if it is unknown.
inline float emission_density(const VcmPass& pass, const SceneLight& light, const Light& state, const LightStart& start,
                              const EmissionPdf& pdf) {
  return pdf.position * pdf.direction *
         start_density(pass.guides, pass.scene, light, state, start.ray, start.normal, start.primitive);
}
inline float emission_density(const VcmPass& pass, const SceneLight& light, const Light& state,
                              const LightStart& start) {
  return emission_density(pass, light, state, start, state.pdf_emit(start.ray, start.normal, start.primitive));
}

/// Returns the sums of a light subpath at its first vertex, at `at`. `distance2` is the squared length of the first segment,
/// `cosine` the area_cosine() there. The start's density is what the other ways take it for, rather than that of the numbers
/// that were drawn: a light need not tell its numbers.
inline SubpathWeights weights_at_first_vertex(const VcmPass& pass, const SceneLight& scene_light, const Light& light,
                                              const Emission& emission, const LightReceiver& at, float distance2,
                                              float cosine) {
  const LightStart start{emission.ray, emission.normal, emission.primitive};
  const float emitted = emission_density(pass, scene_light, light, start, emission.pdf),
              samples = light_samples(pass.scene, scene_light, at);
  const Vec3& w = emission.ray.direction;
  if (is_parallel(light, emission.pdf)) {
    const bool delta = emission.pdf.delta_direction;
    const float next_event = samples * (delta ? 1 : pdf_w_of(light, start, at.p));
    return SubpathWeights::leaving_light(next_event, emitted, delta ? 0.f : 1.f).arrived(1, cosine);
  }
  if (emission.pdf.delta_position) return SubpathWeights::leaving_light(samples, emitted, 0).arrived(distance2, cosine);
  const float cosine_at_light = std::abs(dot(emission.normal, w));
  const float next_event = samples * pdf_w_of(light, start, at.p) * cosine_at_light / distance2;
  return SubpathWeights::leaving_light(next_event, emitted, cosine_at_light).arrived(distance2, cosine);
}

/// Returns a light subpath's density, by area, at a vertex that a shadow ray connects to the light, over that of the
/// shadow ray. `cosine` is the area_cosine() towards the light.
inline float emission_over_next_event(const VcmPass& pass, const LightSample& sample, const LightReceiver& at,
                                      float cosine) {
  const Illumination& lit = sample.lit;
  const LightStart start = start_of(lit, at.p);
  const EmissionPdf pdf = sample.light.pdf_emit(start.ray, start.normal, start.primitive);
  const float emitted = emission_density(pass, sample.scene_light, sample.light, start, pdf) * cosine;
  if (emitted == 0) return 0;
  const bool delta = !(sample.pdf_w > 0);
  const float own = delta ? light_samples(pass.scene, sample.scene_light, at) : sample.pdf_w;
  if (is_parallel(sample.light, pdf)) return emitted / own;
  // A point of a surface has a density by area there: the distance cancels.
  return delta ? emitted / (own * lit.distance * lit.distance) : emitted / (own * std::abs(dot(lit.normal, lit.wi)));
}

}  // namespace dspm
