// Light of lights along hit points' camera paths: what they meet on their way, and direct light that shadow rays bring to their
// vertices.
#pragma once

#include <span>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/beam_light.h"
#include "dspm/integrators/photons/hit_point_writer.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/integrators/transport/lobe_choice.h"
#include "dspm/integrators/transport/medium_passage.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class HitPointLight {
 public:
  HitPointLight(const Scene& scene, const RenderSettings& render, const HitPointSettings& settings, HitPointWriter& out)
      : scene_(scene), render_(render), settings_(settings), out_(out), of_beams_(scene, out) {}

  /// Adds light from infinity that the path meets as it leaves the scene in these frames.
  void meet_infinity(const CameraPath& path, FrameSet frames);
  /// Adds what the surface emits back along the path.
  void meet_surface(const CameraPath& path, const Vertex& vertex);

  /// Adds direct light that a medium scatters along a section of the path's segment.
  void add(const CameraPath& path, const MediumSection& section) {
    if (settings_.light_media && path.bounces < settings_.max_depth) of_beams_.add(path, section);
  }

  /// What a vertex is made of in some of its frames, and the lobes that were chosen there.
  struct Surface {
    FrameSet frames;
    const Bsdf* bsdf;
    LobeChoice choice;
  };

  /// Adds direct light by one shadow ray, and by another for each light that a ray tells all about. Rough lobes do not
  /// wait until they are chosen, and share the ray with glossy ones: highlights of a coat need no path that chooses the
  /// coat. If photons bring rough lobes their light, glossy ones get a ray once they are chosen. Once the path has left
  /// a hit point, photons there bring what glossy lobes scatter. Frames whose surfaces differ share samples and rays.
  void add(const CameraPath& path, const Vertex& vertex, std::span<const Surface> surfaces);

  /// Returns whether rays that are scattered at hit points look for lights.
  bool scatters() const;

 private:
  /// Returns the weight of such a ray, of a path that has left a hit point, which meets the light at `start`.
  float weight_of_scattered(const CameraPath& path, const SceneLight& light, const Light& state,
                            const LightStart& start) const;

  const Scene& scene_;
  const RenderSettings& render_;
  const HitPointSettings& settings_;
  HitPointWriter& out_;
  BeamLight of_beams_;
};

}  // namespace dspm
