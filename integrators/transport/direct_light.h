// Direct light at a point of a surface or of a medium from one shadow ray, for all frames of a path at once.
#pragma once

#include <cmath>
#include <type_traits>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/statistics.h"
#include "dspm/integrators/transport/body.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/medium_vertex.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

inline constexpr float kShortOfLight = 1 - 1e-4f;

/// A shadow ray that stops short of the light's surface.
inline Ray shadow_ray(const SurfacePoint& point, const Illumination& light) {
  Ray ray = point.spawn(light.wi);
  if (!std::isfinite(light.distance)) return ray;
  // Re-aimed from the offset origin: a grazing ray would otherwise miss the light's point.
  const Vec3 to_light = point.p + light.wi * light.distance - ray.origin;
  const float distance = length(to_light);
  if (distance > 0) ray.direction = to_light / distance, ray.t_max = distance * kShortOfLight;
  return ray;
}

/// The point as one that gets light, for the choice among many lights.
inline LightReceiver receiver_at(const SurfacePoint& point) { return {point.p, point.turns ? Vec3{} : point.ng}; }

/// The mean number of samples that sample_direct_light() takes of a light, as far as weights go: the mean over the
/// frames of the file that have the light, if these choose differently.
inline float light_samples(const Scene& scene, const SceneLight& light, const LightReceiver& at) {
  const auto index = static_cast<std::size_t>(&light - scene.lights.data());
  if (scene.direct_light.size() == 1) return scene.direct_light.front().mean(at, index);
  float sum = 0;
  for (std::size_t c = 0; c < scene.direct_light.size(); ++c)
    if (light.choice_shares[c] > 0) sum += light.choice_shares[c] * scene.direct_light[c].mean(at, index);
  return sum;
}

/// Returns whether a shadow ray from each vertex tells all about the light there: nothing but whether it is seen is
/// open.
inline bool is_told_by_a_ray(const Scene& scene, const SceneLight& light) {
  return light.is_delta && light.probability > 0 && scene.lights.size() <= LightSamples::kFewLights;
}

/// The start of light, as in Emission.
struct LightStart {
  Ray ray;
  Vec3 normal;
  int primitive;
};

/// Returns the start of a sample of a light at p. Light from infinitely far away starts at p itself: its line matters,
/// not its start.
inline LightStart start_of(const Illumination& lit, const Vec3& p) {
  return {{std::isfinite(lit.distance) ? p + lit.wi * lit.distance : p, -lit.wi}, lit.normal, lit.primitive};
}

/// Returns the density by solid angle with which light.illuminate(p) samples what starts there; 0 for a delta light.
inline float pdf_w_of(const Light& light, const LightStart& start, const Vec3& p) {
  if (light.is_infinite()) return light.escaped_pdf_w({p, -start.ray.direction});
  SurfacePoint point{};
  point.p = start.ray.origin, point.ng = point.ns = start.normal;
  return light.pdf_w(p, point, start.primitive);
}

/// A sample of a light, as seen from a vertex.
struct LightSample {
  const SceneLight& scene_light;
  const Light& light;
  const Illumination& lit;
  float pdf_w;  // by solid angle; includes light_samples(); 0 for a delta light
};

/// One of the light samples at a vertex, chosen as they arrive, for frames that choose from the same ones.
struct ChosenSample {
  FrameSet frames;
  float u;        // uniform in [0, 1), whatever has been chosen
  float sum = 0;  // of the weights so far
  float weight = 0;
  int number = -1;  // of the chosen one: none
  const SceneLight* light = nullptr;
  Illumination lit = {};
  Spectrum radiance = {};

  /// Weights are square roots of the radiance: light that is faint, but perhaps the only one in the open, has its
  /// chance.
  void offer(int of, const SceneLight& scene_light, const Illumination& from, const Spectrum& scattered) {
    const float offered = std::sqrt(max_component(scattered));
    sum += offered;
    const float chance = offered / sum;
    if (u < chance) {
      u /= chance;
      weight = offered, number = of, light = &scene_light, lit = from, radiance = scattered;
    } else {
      u = (u - chance) / (1 - chance);
    }
  }
};

/// Offers a sample that exists in `frames` to the choices of these frames. A choice that has other frames as well is
/// split first.
template <class Offer>
void offer_to(FrameSet frames, FrameArray<ChosenSample>& choosing, Offer&& offer) {
  FrameSet left = frames;
  for (std::size_t i = 0, count = choosing.size(); i < count && !left.empty(); ++i) {
    const FrameSet others = choosing[i].frames - frames;
    if (others == choosing[i].frames) continue;
    left -= choosing[i].frames;
    if (!others.empty()) {
      choosing.add(choosing[i]).frames = others;
      choosing[i].frames &= frames;
    }
    offer(choosing[i]);
  }
}

/// Traces a shadow ray to each sample that was chosen, by for_each_lit(const ChosenSample&, FrameSet, see), and calls
/// fn(FrameSet, const Spectrum&, giver) as sample_direct_light() does.
template <class ForEachLit, class Fn>
void see_chosen(const Scene& scene, FrameArray<ChosenSample>& choosing, ForEachLit&& for_each_lit, Fn&& fn) {
  for (std::size_t i = 0; i < choosing.size(); ++i) {
    const ChosenSample first = choosing[i];
    if (first.frames.empty() || first.number < 0) continue;
    // Frames that choose the same sample share its shadow ray.
    FrameSet together;
    const auto is_same = [&](const ChosenSample& other) { return other.number == first.number; };
    for (const ChosenSample& chosen : choosing)
      if (is_same(chosen)) together |= chosen.frames;
    for_each_lit(first, together, [&](FrameSet open, const Spectrum& transmittance) {
      for (const ChosenSample& chosen : choosing) {
        const FrameSet lit = chosen.frames & open;
        if (!is_same(chosen) || lit.empty()) continue;
        fn(lit, chosen.radiance * (chosen.sum / chosen.weight) * transmittance,
           [&] { return light_element(scene, *chosen.light); });
      }
    });
    for (ChosenSample& chosen : choosing)
      if (is_same(chosen)) chosen.frames = {};
  }
}

/// Fetches the memory that sample_direct_light() will wait for at the next vertex; call it as the path sets out.
/// Pictures of skies are too large for caches, and each sample looks elsewhere.
inline void prefetch_direct_light(const Scene& scene, const PathState& path) {
  if (scene.infinite_lights.empty()) return;
  const Vec2 u = path.random.pair(path.bounces + 1, kLightPoint);
  for (const int index : scene.infinite_lights)
    scene.lights[static_cast<std::size_t>(index)].states.for_each(
        path.frames, [&](FrameSet, const Light& light) { light.prefetch(u); });
}

/// The lights that is_told_by_a_ray() is true for: one shadow ray each, or a chance to be the one that is chosen.
enum class DeltaLights { each, chosen };

inline Ray shadow_ray(const Vertex& vertex, const Illumination& light) { return shadow_ray(vertex.point, light); }
inline Ray shadow_ray(const MediumVertex& vertex, const Illumination& light) {
  return {vertex.p(), light.wi, light.distance * kShortOfLight};
}

/// Calls take(FrameSet, const Spectrum& f) with what a place scatters of a light's sample in these frames: `scattered` is a
/// function of the sample, if it scatters alike in all of them, or of (frames, sample, take).
template <class ScatteringFunction, class Take>
void for_each_scattered(FrameSet frames, const LightSample& sample, ScatteringFunction& scattered, Take&& take) {
  if constexpr (std::is_invocable_v<ScatteringFunction&, const LightSample&>)
    take(frames, scattered(sample));
  else
    scattered(frames, sample, take);
}

/// Samples lights with the path's random numbers for its next bounce, traces a shadow ray to one of the samples and
/// calls fn(FrameSet, const Spectrum&, giver) with the radiance that the place, a Vertex or a MediumVertex, scatters back along
/// the path, for those of `frames` in which nothing is in between. `scattered` gives f, weighted if other ways find the
/// same light, to for_each_scattered(). Radiance that is negative or not finite is passed on; giver() then returns its
/// source.
template <class Place, class ScatteringFunction, class Fn>
void sample_direct_light(const Scene& scene, const PathState& path, const Place& place, FrameSet frames,
                         PathCounts& counts, ScatteringFunction&& scattered, Fn&& fn,
                         DeltaLights delta_lights = DeltaLights::chosen) {
  const int bounce = path.bounces + 1;
  const Vec2 u = path.random.pair(bounce, kLightPoint);
  const LightReceiver receiver = place.receiver();
  FrameArray<ChosenSample> choosing;
  choosing.add({frames, path.random.pair(bounce, kLightDirection).x});
  const auto for_each_lit = [&](const Illumination& lit, FrameSet of, auto&& see) {
    ++counts.shadow_rays;
    for_each_open(scene, shadow_ray(place, lit), place.inside_beyond(path.inside, lit.wi), of, {path.random, bounce},
                  see);
  };
  int offers = 0;
  // Of a light that is sampled several times, each sample has a part of the numbers to itself.
  const auto sample = [&](const SceneLight& scene_light, FrameSet of, float samples, Vec2 numbers) {
    const float in_weights = scene.direct_light.size() == 1 ? samples : light_samples(scene, scene_light, receiver);
    scene_light.states.for_each(of, [&](FrameSet common, const Light& light) {
      const auto lit = light.illuminate(place.p(), numbers);
      if (!lit) return;
      const float pdf_w = samples * lit->pdf_w, cosine = place.cosine(lit->wi);
      const Spectrum carried = light.carried(lit->radiance, *scene.palette);
      FrameArray<FrameFactor> received;
      const auto receive = [&](FrameSet alike, const Spectrum& unprojected) {
        const Spectrum f = unprojected * cosine;
        if (is_black(f)) return;
        const Spectrum radiance = f * carried / (pdf_w > 0 ? pdf_w : samples);
        if (!is_light(radiance)) {
          const SceneElement giver = is_light(f) ? light_element(scene, scene_light) : place.scatterer();
          fn(alike, radiance, [&] { return giver; });
        } else if (max_component(radiance) > 0) {
          received.add({alike, radiance});
        }
      };
      for_each_scattered(common, LightSample{scene_light, light, *lit, in_weights * lit->pdf_w}, scattered, receive);
      if (received.empty()) return;
      if (delta_lights == DeltaLights::each && is_told_by_a_ray(scene, scene_light)) {
        FrameSet receiving;
        for (const FrameFactor& r : received) receiving |= r.frames;
        for_each_lit(*lit, receiving, [&](FrameSet open, const Spectrum& transmittance) {
          for (const FrameFactor& r : received)
            if (const FrameSet lit_frames = r.frames & open; !lit_frames.empty())
              fn(lit_frames, r.factor * transmittance, [&] { return light_element(scene, scene_light); });
        });
      } else {
        for (const FrameFactor& r : received)
          offer_to(r.frames, choosing,
                   [&](ChosenSample& chosen) { chosen.offer(offers, scene_light, *lit, r.factor); });
      }
      ++offers;
    });
  };
  const Vec2 choice{path.random.number(bounce, kLightChoice), path.random.pair(bounce, kLightDirection).y};
  const double finely = static_cast<double>(choice.x) + 0x1p-24 * static_cast<double>(choice.y);
  for (std::size_t c = 0; c < scene.direct_light.size(); ++c) {
    const FrameSet of = frames & scene.light_choices[c].frames;
    if (of.empty()) continue;
    scene.direct_light[c].for_each(receiver, finely, [&](std::size_t index, float samples, int count) {
      for (int i = 0; i < count; ++i) {
        const float x = u.x + static_cast<float>(i) / static_cast<float>(count);
        sample(scene.lights[index], of, samples, {x < 1 ? x : x - 1, u.y});
      }
    });
  }
  see_chosen(
      scene, choosing, [&](const ChosenSample& chosen, FrameSet of, auto&& see) { for_each_lit(chosen.lit, of, see); },
      fn);
}

}  // namespace dspm
