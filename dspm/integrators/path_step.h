// One step of a path, for camera and photon paths of every integrator: its state, the vertex that it comes to, how it is
// extended, and how it ends.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/dimension.h"
#include "dspm/integrators/strand.h"
#include "dspm/math/frames.h"
#include "dspm/math/ray.h"
#include "dspm/math/rng.h"
#include "dspm/math/vec.h"
#include "dspm/scene/scene.h"

namespace dspm {

/// A path is a value. When frames part, so do copies of it, with disjoint sets.
struct PathState {
  Ray ray;                 // the next segment
  Rgb throughput;          // radiance per radiance (camera), or flux in W (photon); holds 1/pdf of all that was sampled
  FrameSet frames;         // the frames in which this very path exists; shrinks, never grows
  int bounces = 0;         // scatterings so far
  float length = 0;        // of the segments so far, in world units
  float eta_scale = 1;     // of the refractions so far: what throughput will get back on the way out
  StrandList strands = 0;  // what frames carry times the throughput, where they differ
  PathRandom random = {};  // the path's, the same for all its branches
};

inline bool is_finite(const Ray& ray) { return is_finite(ray.origin) && is_finite(ray.direction); }
inline bool is_finite(const SurfacePoint& point) {
  return is_finite(point.p) && is_finite(point.ng) && is_finite(point.ns);
}

/// Where a path meets a surface, in frames that meet the same.
struct Vertex {
  Vertex(const Scene& scene, const Ray& ray, const FrameHit& part)
      : hit(part.hit),
        point(scene.surface_point(part.hit)),
        wo(-ray.direction),
        frames(part.frames),
        shape(scene.shapes[static_cast<std::size_t>(part.hit.shape)]),
        material(scene.materials[static_cast<std::size_t>(shape.material)]) {}

  RayHit hit;
  SurfacePoint point;
  Vec3 wo;  // back along the path, unit length
  FrameSet frames;
  const PlacedShape& shape;
  const FrameStates<Material>& material;

  /// The material is not the same in all of the frames.
  bool differs() const { return material.differs_in(frames); }

  // Whose plugin something is, for what it gives that is not finite.
  ScenePart shape_part() const { return {ScenePart::Kind::shape, hit.shape}; }
  ScenePart material_part() const { return {ScenePart::Kind::material, shape.material}; }
  ScenePart emitter_part() const { return {ScenePart::Kind::light, shape.light}; }
};

/// Calls fn(FrameSet, const Bsdf&) for each scattering that the vertex's frames find there: one, unless the material
/// differs between them.
template <class Fn>
void for_each_surface(const Vertex& vertex, Fn&& fn) {
  vertex.material.for_each(vertex.frames, [&](FrameSet frames, const Material& material) {
    BsdfSlot slot;
    fn(frames, material.bsdf(vertex.point, slot));
  });
}

inline ScenePart light_part(const Scene& scene, const SceneLight& light) {
  return {ScenePart::Kind::light, static_cast<int>(&light - scene.lights.data())};
}

/// The surface's own emission back along the path, frame by frame where it differs: fn(FrameSet, const Rgb&, const
/// Light&).
template <class Fn>
void for_each_emission(const Scene& scene, const Vertex& vertex, FrameSet frames, Fn&& fn) {
  if (vertex.shape.light < 0) return;
  const SceneLight& light = scene.lights[static_cast<std::size_t>(vertex.shape.light)];
  light.states.for_each(frames, [&](FrameSet lit, const Light& state) {
    const Rgb radiance = state.emitted(vertex.point, vertex.wo);
    if (!is_black(radiance)) fn(lit, radiance, state);
  });
}

/// Light from infinitely far for a path that left the scene: fn(FrameSet, const Rgb&, const SceneLight&, const Light&).
template <class Fn>
void for_each_escape(const Scene& scene, FrameSet frames, const Vec3& direction, Fn&& fn) {
  for (const int index : scene.infinite_lights) {
    const SceneLight& scene_light = scene.lights[static_cast<std::size_t>(index)];
    scene_light.states.for_each(frames, [&](FrameSet common, const Light& light) {
      const Rgb radiance = light.escaped(direction);
      if (!is_black(radiance)) fn(common, radiance, scene_light, light);
    });
  }
}

/// Keeps the flux right where the shading normal is not the geometric one: what a photon from wo carries on to wi,
/// beyond f |cos(wi, ns)|. [Veach 1997, 5.3]
inline float shading_correction(const SurfacePoint& point, const Vec3& wo, const Vec3& wi) {
  if (point.ns == point.ng) return 1;
  const float below = std::abs(dot(wo, point.ng) * dot(wi, point.ns));
  return below == 0 ? 0 : std::abs(dot(wo, point.ns) * dot(wi, point.ng)) / below;
}

/// Smooth lobes are followed, rough ones gather or are gathered from; where a surface has both, a path chooses.
struct LobeChoice {
  LobeSet lobes;
  float chance;  // of this choice
  bool rough;
};

// Rougher lobes are not specular: Ggx::kSmoothest is more.
inline constexpr float kLeastRoughness = 1e-4f;

/// Lobes that are followed though they are not specular.
inline LobeSet glossy_lobes(const Bsdf& bsdf, float least_alpha) {
  return static_cast<LobeSet>(bsdf.lobes(kLeastRoughness) & ~bsdf.lobes(least_alpha));
}

inline LobeChoice choose_lobes(const Bsdf& bsdf, const PathState& path, const Vec3& wo, float least_alpha) {
  const LobeSet all = bsdf.all_lobes(), rough = bsdf.lobes(least_alpha), smooth = static_cast<LobeSet>(all & ~rough);
  if (rough == 0 || smooth == 0) return {all, 1, smooth == 0};
  const float rough_chance = bsdf.share(wo, rough);
  if (path.random.number(path.bounces, kSplit) < rough_chance) return {rough, rough_chance, true};
  return {smooth, 1 - rough_chance, false};
}

inline std::optional<BsdfSample> sample_bsdf(const Bsdf& bsdf, const PathState& path, const Vec3& wo,
                                             Transport transport, LobeSet lobes) {
  const Vec2 u = path.random.pair(path.bounces, kScatter);
  return bsdf.sample(wo, {u.x, u.y, path.random.number(path.bounces, kLobe)}, transport, lobes);
}

/// The path's next segment, along the sampled direction; its throughput is left to the caller.
inline void extend_ray(PathState& path, const SurfacePoint& point, const BsdfSample& sample) {
  path.eta_scale *= sample.eta_scale;
  path.ray = point.spawn(sample.wi);
  ++path.bounces;
}
inline void extend(PathState& path, const SurfacePoint& point, const BsdfSample& sample) {
  path.throughput *= sample.weight;
  extend_ray(path, point, sample);
}

inline constexpr int kFirstRouletteBounce = 4;  // of camera paths

/// A camera path's chance to go on after `bounce`: its throughput, as it would be outside of glass.
inline float roulette_chance(const Rgb& throughput, float eta_scale, int bounce) {
  return bounce < kFirstRouletteBounce ? 1 : std::min(1.f, max_component(throughput) / eta_scale);
}

/// Russian roulette: survives where u < p, and is divided by p. Frames share u, so they decide alike where p is equal.
inline bool survives(PathState& path, float p, float u) {
  if (p >= 1) return true;
  if (!(u < p)) return false;
  path.throughput *= 1 / p;
  return true;
}

}  // namespace dspm
