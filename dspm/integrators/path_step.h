// One step of a path, for camera and photon paths of every integrator: what a path is, where it goes on, and how it
// ends.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/statistics.h"
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
};

/// The random numbers' dimensions at one bounce. A path's start takes the last three of bounce 0, so direct light at
/// the vertex of bounce b takes those of b + 1.
enum Dimension : int { kScatter, kLobe, kRoulette, kSplit, kLightChoice, kLightPoint, kLightDirection };

/// The paths still to be followed. Their sets are disjoint, so there are never more than frames.
template <class Path = PathState>
class PathStack {
 public:
  bool empty() const { return count_ == 0; }
  /// The path's copy in the stack, to be changed in place until the next push or pop.
  Path& push(const Path& path) { return paths_[static_cast<std::size_t>(count_++)] = path; }
  Path pop() { return paths_[static_cast<std::size_t>(--count_)]; }
  void drop() { --count_; }

 private:
  std::array<Path, kMaxFrames> paths_;
  int count_ = 0;
};

inline const FrameStates<Material>& material_at(const Scene& scene, const RayHit& hit) {
  return scene.materials[static_cast<std::size_t>(scene.shapes[static_cast<std::size_t>(hit.shape)].material)];
}

inline bool is_finite(const Ray& ray) { return is_finite(ray.origin) && is_finite(ray.direction); }
inline bool is_finite(const SurfacePoint& point) {
  return is_finite(point.p) && is_finite(point.ng) && is_finite(point.ns);
}

/// Calls fn(FrameSet, const Bsdf&) for each scattering that the part's frames find at its hit: one, unless the material
/// differs between them.
template <class Fn>
void for_each_surface(const Scene& scene, const FrameHit& part, const SurfacePoint& point, Fn&& fn) {
  material_at(scene, part.hit).for_each(part.frames, [&](FrameSet frames, const Material& material) {
    BsdfSlot slot;
    fn(frames, material.bsdf(point, slot));
  });
}

/// Of whose plugin something is, for what it gives that is not finite.
inline ScenePart shape_part(const RayHit& hit) { return {ScenePart::Kind::shape, hit.shape}; }
inline ScenePart material_part(const Scene& scene, const RayHit& hit) {
  return {ScenePart::Kind::material, scene.shapes[static_cast<std::size_t>(hit.shape)].material};
}
inline ScenePart emitter_part(const Scene& scene, const RayHit& hit) {
  return {ScenePart::Kind::light, scene.shapes[static_cast<std::size_t>(hit.shape)].light};
}
inline ScenePart light_part(const Scene& scene, const SceneLight& light) {
  return {ScenePart::Kind::light, static_cast<int>(&light - scene.lights.data())};
}

/// The light that a hit surface itself sends towards w, frame by frame where it differs: fn(FrameSet, const Rgb&, const
/// Light&).
template <class Fn>
void for_each_emission(const Scene& scene, const FrameHit& part, const SurfacePoint& point, const Vec3& w, Fn&& fn) {
  const PlacedShape& shape = scene.shapes[static_cast<std::size_t>(part.hit.shape)];
  if (shape.light < 0) return;
  scene.lights[static_cast<std::size_t>(shape.light)].states.for_each(part.frames,
                                                                      [&](FrameSet frames, const Light& light) {
                                                                        const Rgb radiance = light.emitted(point, w);
                                                                        if (!is_black(radiance))
                                                                          fn(frames, radiance, light);
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

inline LobeChoice choose_lobes(const Bsdf& bsdf, const Vec3& wo, float least_alpha, const PathRandom& random,
                               int bounce) {
  const LobeSet all = bsdf.all_lobes(), rough = bsdf.lobes(least_alpha), smooth = static_cast<LobeSet>(all & ~rough);
  if (rough == 0 || smooth == 0) return {all, 1, smooth == 0};
  const float rough_chance = bsdf.share(wo, rough);
  if (random.number(bounce, kSplit) < rough_chance) return {rough, rough_chance, true};
  return {smooth, 1 - rough_chance, false};
}

inline std::optional<BsdfSample> sample_bsdf(const Bsdf& bsdf, const Vec3& wo, const PathRandom& random, int bounce,
                                             Transport transport, LobeSet lobes) {
  const Vec2 u = random.pair(bounce, kScatter);
  return bsdf.sample(wo, {u.x, u.y, random.number(bounce, kLobe)}, transport, lobes);
}

/// Moves `path` on along the sampled direction; its throughput is left to the caller.
inline void move_on(PathState& path, const SurfacePoint& point, const BsdfSample& sample) {
  path.eta_scale *= sample.eta_scale;
  path.ray = point.spawn(sample.wi);
  ++path.bounces;
}
inline void extend(PathState& path, const SurfacePoint& point, const BsdfSample& sample) {
  path.throughput *= sample.weight;
  move_on(path, point, sample);
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
