// Finds what is seen in mirrors and through glass and water: the first rough surface after smooth ones.
#pragma once

#include <utility>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/statistics.h"
#include "dspm/integrators/transport/branching_path.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/transport/path_step.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Follows camera paths along smooth lobes. If light is both reflected and refracted, they go where most of it comes
/// from: so neighbouring pixels agree, and nothing that they see is noisy. The throughput is the light that is left on
/// its way from the surface, without the camera's weight and the scale of radiance in glass.
class ClearSight {
 public:
  explicit ClearSight(const Scene& scene) : branches_(scene, counts_) {}

  /// Follows the path from its first vertex. Calls rough(const CameraPath&, const Vertex&, const Bsdf&), in the path's
  /// frames, at ends on surfaces, and nothing(const CameraPath&, FrameSet) at the others. A path's length reaches to
  /// its end.
  template <class Rough, class Nothing>
  void follow(CameraPath path, const Vertex& first, Rough&& rough, Nothing&& nothing) {
    Tracer<Rough, Nothing> tracer{branches_, rough, nothing};
    path.throughput = Spectrum(1), path.wavelength = {};  // glass bends what is seen by its mean index
    tracer.arrived(path, first);
    branches_.follow(tracer);
  }

 private:
  static constexpr int kMostBounces = 8;
  static constexpr float kRoughFrom = 0.05f;  // GGX alpha
  /// A surface is an end if rough lobes scatter at it with a greater probability than this: varnish does not hide what
  /// is below.
  static constexpr float kRoughShare = 0.25f;

  template <class Rough, class Nothing>
  struct Tracer {
    BranchingPath<CameraPath>& branches;
    Rough& rough;
    Nothing& nothing;

    bool postpones(const CameraPath&, const HitPartition&) { return false; }
    void escaped(const CameraPath& path, FrameSet frames) { nothing(path, frames); }
    void lost(const CameraPath& path, FrameSet frames, const SceneElement&) { nothing(path, frames); }
    void arrived(const CameraPath& arriving, const Vertex& vertex) {
      for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
        CameraPath path = arriving;
        path.frames = frames, path.travel(vertex.hit.t);
        if (!go_on(path, vertex, bsdf)) rough(path, vertex, bsdf);
      });
    }

    bool go_on(const CameraPath& path, const Vertex& vertex, const Bsdf& bsdf) {
      if (path.bounces >= kMostBounces || vertex.shape.light >= 0) return false;
      const LobeSet of_rough = bsdf.lobes(kRoughFrom), smooth = static_cast<LobeSet>(bsdf.all_lobes() & ~of_rough);
      if (smooth == 0 || (of_rough != 0 && bsdf.lobe_probability(vertex.wo, of_rough) > kRoughShare)) return false;
      constexpr float kLikelier = 0.5f;  // of two lobes
      const Vec2 u = path.random.pair(path.bounces, kScatter);
      const auto sample = bsdf.sample(vertex.wo, {u.x, u.y, kLikelier}, Transport::radiance, smooth);
      if (!sample || !is_finite(sample->wi) || !is_finite(sample->weight)) return false;
      CameraPath& branch = branches.push(path);
      branch.throughput *= sample->weight / sample->eta_scale;
      extend_ray(branch, vertex, *sample);
      branch.leave(vertex, *sample);
      return true;
    }
  };

  PathCounts counts_;  // not of the render's work
  BranchingPath<CameraPath> branches_;
};

}  // namespace dspm
