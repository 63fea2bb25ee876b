// Path tracing with next event estimation, both ways of finding a light combined by the balance heuristic [Veach 1997].
#pragma once

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/caught_light.h"
#include "dspm/integrators/seen_light.h"
#include "dspm/integrators/transport/balance.h"
#include "dspm/integrators/transport/branching_path.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/roulette.h"
#include "dspm/integrators/transport/scattering_place.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The limits of paths.
struct PathLimits {
  int max_depth;
  bool indirect;  // else a path that a rough surface has scattered only looks for lights
};

/// Camera paths that look for lights at each vertex. `out` gets all light, and how often it has been scattered:
/// out.add(const SeenLight&, int scatterings).
template <class Out>
class PathTracer {
 public:
  PathTracer(const Scene& scene, const RenderSettings& render, const PathLimits& limits, Out& out)
      : scene_(scene), render_(render), limits_(limits), out_(out), branches_(scene, counts_) {}

  void trace(int x, int y, std::uint64_t iteration) {
    start_camera_paths(
        scene_, render_, x, y, iteration, [&](const CameraPath& path) { set_out(path); },
        [&](const CameraPath& path) { reject(path, path.frames, {SceneElement::Kind::camera}); });
    branches_.follow(*this);
    branches_.count_path();
  }

  const PathCounts& counts() const { return counts_; }
  const Rejections& rejections() const { return rejections_; }

 private:
  friend BranchingPath<CameraPath>;
  friend MediumSegment<BranchingPath<CameraPath>>;

  bool postpones(const CameraPath&, const HitPartition&) { return false; }

  void arrived(const CameraPath& arriving, const Vertex& vertex) {
    CameraPath path = arriving;
    path.frames = vertex.frames;
    path.arrive(scene_, vertex);
    add_emission(path, vertex);
    scatter_light(path, vertex);
  }

  void collided(const CameraPath& arriving, const MediumVertex& vertex) {
    CameraPath path = arriving;
    path.collide();
    scatter_light(path, vertex);
  }

  void glowed(const CameraPath& passing, FrameSet frames, const Spectrum& radiance) {
    CameraPath path = passing;
    path.collide();
    add(path, path.bounces, frames, path.throughput * radiance,
        [&] { return glow_element(scene_, path.inside.medium); });
  }

  void escaped(const CameraPath& path, FrameSet frames) {
    if (render_.transparent && path.bounces == 0) return;
    for_each_escape(scene_, frames, path.ray, path.bounces,
                    [&](FrameSet lit, const Spectrum& radiance, const SceneLight& scene_light, const Light& light) {
                      add(path, path.bounces, lit,
                          path.throughput * radiance * weight_of_escape(scene_, path, scene_light, light),
                          [&] { return light_element(scene_, scene_light); });
                    });
  }

  void lost(const CameraPath& path, FrameSet frames, const SceneElement& giver) { reject(path, frames, giver); }

  void add_emission(const CameraPath& path, const Vertex& vertex) {
    for_each_emission(scene_, vertex, vertex.frames, [&](FrameSet lit, const Spectrum& radiance, const Light& light) {
      add(path, path.bounces, lit, path.throughput * radiance * weight_of_hit(scene_, path, vertex, light),
          [&] { return vertex.emitter_element(); });
    });
  }

  /// Looks for lights from the place, and goes on.
  template <class Place>
  void scatter_light(const CameraPath& path, const Place& place) {
    if (path.bounces >= limits_.max_depth || path.indirect) return;
    FrameArray<Surface> surfaces;
    for_each_scattering(place, path.frames, [&](FrameSet frames, const Bsdf& bsdf) {
      surfaces.add({frames, BsdfSlot::copy_of(bsdf)});
    });
    add_direct_light(path, place, surfaces);
    for (const Surface& surface : surfaces) {
      CameraPath branch = path;
      branch.frames = surface.frames, branch.travel(length_to(place));
      scatter(branch, place, *surface.bsdf);
    }
  }

  /// Frames whose surfaces differ share samples and rays.
  template <class Place>
  void add_direct_light(const CameraPath& path, const Place& place, const FrameArray<Surface>& surfaces) {
    const auto scattered = [&](FrameSet of, const LightSample& sample, auto&& take) {
      for (const Surface& surface : surfaces) {
        const FrameSet common = surface.frames & of;
        if (!common.empty()) take(common, weighted_f(place.wo, *surface.bsdf, sample));
      }
    };
    sample_direct_light(scene_, path, place, path.frames, counts_, scattered,
                        [&](FrameSet lit, const Spectrum& radiance, auto&& giver) {
                          add(path, path.bounces + 1, lit, path.throughput * radiance, giver);
                        });
  }

  static Spectrum weighted_f(const Vec3& wo, const Bsdf& bsdf, const LightSample& sample) {
    const LobeSet all = bsdf.all_lobes();
    const Spectrum f = bsdf.evaluate(wo, sample.lit.wi, Transport::radiance, all);
    if (is_black(f) || !(sample.pdf_w > 0)) return f;
    return f * balance(sample.pdf_w, bsdf.pdf_w(wo, sample.lit.wi, Transport::radiance, all));
  }

  template <class Place>
  void scatter(CameraPath& path, const Place& place, const Bsdf& bsdf) {
    const auto sample = sample_bsdf(bsdf, path, place.wo, Transport::radiance, bsdf.all_lobes());
    if (!sample) return;
    path.throughput *= sample->weight;
    leave(path, place, *sample);
    if (!is_finite(path.ray) || !is_light(path.throughput)) return reject(path, path.frames, place.scatterer());
    path.indirect = !limits_.indirect && !sample->specular;
    go_on(path);
  }

  /// Plays roulette at the vertex that the path has left.
  void go_on(CameraPath& path) {
    if (is_black(path.throughput)) return;
    const int bounce = path.bounces - 1;
    const float chance = roulette_chance(path.throughput, path.eta_scale, bounce);
    if (chance >= 1 || survives(path, chance, path.random.number(bounce, kRoulette))) set_out(path);
  }

  void set_out(const CameraPath& path) {
    if (path.bounces < limits_.max_depth && !path.indirect) prefetch_direct_light(scene_, path);
    branches_.push(path);
  }

  /// Adds light. `giver` returns its source: the light if the radiance is finite, else the one to blame.
  template <class WhoGave>
  void add(const CameraPath& path, int scatterings, FrameSet frames, const Spectrum& radiance, WhoGave&& giver) {
    if (is_light(radiance))
      return out_.add(
          {frames, scene_.palette->seen(radiance), path.pixel, light_of(giver()), path.caught, path.of_media},
          scatterings);
    reject(path, frames, giver());
  }
  void reject(const CameraPath& path, FrameSet frames, const SceneElement& giver) {
    rejections_.add(giver, frames, path.pixel);
  }

  const Scene& scene_;
  const RenderSettings& render_;
  const PathLimits& limits_;
  Out& out_;
  PathCounts counts_;
  Rejections rejections_;
  BranchingPath<CameraPath> branches_;
};

}  // namespace dspm
