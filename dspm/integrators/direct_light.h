// Direct light at a surface from one shadow ray, for all frames of a path at once.
#pragma once

#include "dspm/colour/rgb.h"
#include "dspm/integrators/path_step.h"
#include "dspm/integrators/statistics.h"
#include "dspm/math/frames.h"
#include "dspm/math/ray.h"
#include "dspm/math/vec.h"
#include "dspm/scene/scene.h"

namespace dspm {

/// A shadow ray that stops short of the light's surface.
inline Ray shadow_ray(const SurfacePoint& point, const Illumination& light) {
  constexpr float kShort = 1 - 1e-4f;
  Ray ray = point.spawn(light.wi);
  if (!std::isfinite(light.distance)) return ray;
  // Re-aimed from the offset origin: a grazing ray would otherwise miss the light's point.
  const Vec3 to_light = point.p + light.wi * light.distance - ray.origin;
  const float distance = length(to_light);
  if (distance > 0) ray.direction = to_light / distance, ray.t_max = distance * kShort;
  return ray;
}

/// Calls fn(FrameSet, const Rgb& transmittance) for the frames in which nothing blocks the segment.
template <class Fn>
void for_each_open(const Scene& scene, const Ray& segment, FrameSet frames, Fn&& fn) {
  const FrameSet open = frames - scene.accel->occluded(segment, frames);
  if (!open.empty()) fn(open, Rgb(1));
}

/// Samples a light and a direction with the path's random numbers for its next bounce and calls
/// fn(FrameSet, const Rgb&, giver) with the radiance that the vertex scatters back along the path, for those of
/// `frames` in which nothing is in between. It is weighted by `weight(wi, pdf_w)`; pdf_w (by solid angle) includes the
/// probability of choosing the light and is 0 for delta lights. Radiance that is not finite is passed on; giver() then
/// returns its source.
template <class Weight, class Fn>
void sample_direct_light(const Scene& scene, const PathState& path, const Vertex& vertex, FrameSet frames,
                         const Bsdf& bsdf, LobeSet lobes, PathCounts& counts, Weight&& weight, Fn&& fn) {
  const ChosenLight chosen = scene.choose_light(path.random.number(path.bounces + 1, kLightChoice));
  if (chosen.probability == 0) return;
  const Vec2 u = path.random.pair(path.bounces + 1, kLightPoint);
  const SurfacePoint& point = vertex.point;
  scene.lights[static_cast<std::size_t>(chosen.index)].states.for_each(
      frames, [&](FrameSet common, const Light& light) {
        const auto lit = light.illuminate(point.p, u);
        if (!lit) return;
        const float pdf_w = chosen.probability * lit->pdf_w;
        const Rgb f = bsdf.evaluate(vertex.wo, lit->wi, Transport::radiance, lobes) * std::abs(dot(lit->wi, point.ns));
        const Rgb radiance = f * lit->radiance * (weight(lit->wi, pdf_w) / (pdf_w > 0 ? pdf_w : chosen.probability));
        if (is_black(radiance)) return;
        const auto giver = [&] {
          return is_finite(f) ? SceneElement{SceneElement::Kind::light, chosen.index} : vertex.material_element();
        };
        if (!is_finite(radiance)) return fn(common, radiance, giver);
        ++counts.shadow_rays;
        for_each_open(scene, shadow_ray(point, *lit), common,
                      [&](FrameSet open, const Rgb& transmittance) { fn(open, radiance * transmittance, giver); });
      });
}

}  // namespace dspm
