// The light subpath that a camera path is connected to, and the connections of a camera vertex to its vertices: one
// shadow ray for all frames that hold both ends, each frame with its own scattering functions and weight.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/methods/vcm/camera_vertex.h"
#include "dspm/integrators/methods/vcm/light_subpaths.h"
#include "dspm/integrators/methods/vcm/subpath_place.h"
#include "dspm/integrators/methods/vcm/vcm_pass.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class LightSubpath {
 public:
  void load(const Scene& scene, std::span<const LightVertex> vertices, const StrandTable& strands);

  /// Calls fn(const Brought&) for what each vertex sends by way of the camera vertex, if nothing is in between.
  template <class Place, class Fn>
  void for_each_connection(const VcmPass& pass, const CameraVertex<Place>& camera, PathCounts& counts, Fn&& fn) const {
    const Place& place = camera.place;
    for (const End& end : ends_) {
      if (camera.bounces + end.vertex->bounces + 2 > pass.settings.max_depth) continue;
      const FrameSet frames = camera.frames & end.vertex->frames;
      const Vec3 way = end.p - place.p();
      const float distance = length(way);
      if (frames.empty() || !(distance > 0)) continue;
      const Vec3 w = way / distance;
      const Beginning beginning{
          place.wo, w, distance, area_cosine(place, w), place.cosine(w), ways_at(pass.ways, place), camera.is_alone};
      FrameArray<Brought> parts;
      const FrameSet joined = join(pass, beginning, camera.surfaces, camera.weights, end, frames, parts);
      if (joined.empty()) continue;
      ++counts.shadow_rays;
      const Ray segment = shadow_ray(place, {w, distance, Rgb(), 0});
      const Inside inside = place.inside_beyond(camera.inside, segment.direction);
      for_each_open(pass.scene, segment, inside, joined, {camera.random, camera.bounces + 1},
                    [&](FrameSet open, const Spectrum& transmittance) {
                      for (const Brought& part : parts)
                        if (const FrameSet lit = part.frames & open; !lit.empty())
                          fn(Brought{lit, part.radiance * transmittance, part.strands, part.light});
                    });
    }
  }

 private:
  struct End {
    const LightVertex* vertex;
    const Strand* strands;
    Vec3 p, ng;                // no normal: in a medium
    std::size_t first, count;  // of its surfaces

    float area_cosine(const Vec3& w) const { return vertex->medium != kNoMedium ? 1 : std::abs(dot(w, ng)); }
  };
  /// The camera's vertex, where the connection in direction w begins.
  struct Beginning {
    Vec3 wo, w;
    float distance, area_cosine, cosine;
    VcmWays ways;
    bool is_alone;
  };

  void load_on_surface(const Scene& scene, const LightVertex& light, const Strand* strands);
  void load_in_medium(const Scene& scene, const LightVertex& light, const Strand* strands);
  /// Adds what comes from the end in each of these frames if nothing is in between; returns the frames with light.
  FrameSet join(const VcmPass& pass, const Beginning& camera, std::span<const Surface> surfaces,
                const SubpathWeights& weights, const End& end, FrameSet frames, FrameArray<Brought>& parts) const;

  std::vector<End> ends_;
  std::vector<Surface> surfaces_;  // of all ends
};

}  // namespace dspm
