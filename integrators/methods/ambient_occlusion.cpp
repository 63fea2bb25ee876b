// Integrator "ambientocclusion" "float maxdistance" 2
//
// How much of the sky the surface sees that the camera sees first: 1 if nothing is in the way, 0 in a closed room and
// where the camera sees no surface. Lights and materials do not matter. pbrt-v4's integrator of that name.
//
//   iterations   rays to the sky, a pixel          the sampler's pixelsamples, else 256
//   cossample    rays by the cosine, or uniformly  true; the image is the same, the noise is not
//   maxdistance  how far away things are in the way, in world units; 0: however far   0
#include <fmt/format.h>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/integrators/common_params.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/methods/tile_traced.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/integrators/transport/branching_path.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

struct Hemisphere {
  bool by_cosine;
  float distance;
};

class PixelTracer {
 public:
  PixelTracer(const Scene& scene, const RenderSettings& render, const Hemisphere& hemisphere, SeenLightSums& out)
      : scene_(scene), render_(render), hemisphere_(hemisphere), out_(out), branches_(scene, counts_) {}

  void trace(int x, int y, std::uint64_t iteration) {
    start_camera_paths(
        scene_, render_, x, y, iteration, [&](const CameraPath& path) { branches_.push(path); },
        [&](const CameraPath& path) { lost(path, path.frames, {SceneElement::Kind::camera}); });
    branches_.follow(*this);
    branches_.count_path();
  }

  const PathCounts& counts() const { return counts_; }
  const Rejections& rejections() const { return rejections_; }

 private:
  friend BranchingPath<CameraPath>;
  friend MediumSegment<BranchingPath<CameraPath>>;

  bool postpones(const CameraPath&, const HitPartition&) { return false; }
  void escaped(const CameraPath&, FrameSet) {}
  void lost(const CameraPath& path, FrameSet frames, const SceneElement& giver) {
    rejections_.add(giver, frames, path.pixel);
  }

  void arrived(const CameraPath& path, const Vertex& vertex) {
    const Vec2 u = path.random.pair(0, kScatter);
    const Vec3 local = hemisphere_.by_cosine ? cosine_hemisphere(u) : uniform_hemisphere(u);
    const Vec3 normal = dot(vertex.wo, vertex.point.ng) > 0 ? vertex.point.ng : -vertex.point.ng;
    const Ray ray = vertex.point.spawn(Basis::around(normal).to_world(local), hemisphere_.distance);
    const FrameSet open = vertex.frames - scene_.accel->occluded(ray, vertex.frames);
    counts_.segments.add(vertex.frames.count());
    // cos / (pi pdf), so that the whole hemisphere gives 1.
    if (!open.empty()) out_.add({open, Rgb(hemisphere_.by_cosine ? 1 : 2 * local.z), path.pixel});
  }

  const Scene& scene_;
  const RenderSettings& render_;
  const Hemisphere& hemisphere_;
  SeenLightSums& out_;
  PathCounts counts_;
  Rejections rejections_;
  BranchingPath<CameraPath> branches_;
};

class AmbientOcclusion final : public TileTraced {
 public:
  AmbientOcclusion(int iterations, const Hemisphere& hemisphere, int frames, const RenderSettings& render)
      : TileTraced(iterations, frames, render, at_start()), hemisphere_(hemisphere) {}

  std::string settings() const override {
    return fmt::format("one ray to the sky per pixel and iteration, maxdistance {}", hemisphere_.distance);
  }

 private:
  static Statistics at_start() {
    Statistics statistics;
    statistics.steps = {{"rays"}};
    return statistics;
  }

  void trace(const Iteration& iteration, SeenLightSums& sums, Statistics& statistics) const override {
    trace_pixels(iteration, statistics,
                 [&](const Scene& scene) { return PixelTracer(scene, render(), hemisphere_, sums); });
  }

  Hemisphere hemisphere_;
};

}  // namespace

std::unique_ptr<Integrator> make_ambientocclusion(ParamReader& params, const Scene& scene,
                                                  const RenderSettings& render) {
  const int iterations = read_iterations(params, render, "rays to the sky, a pixel");
  const bool by_cosine = params.flag("cossample", true, "rays by the cosine to the normal, else uniformly");
  const float distance =
      params.number("maxdistance", 0, "world units", "how far away things are in the way; 0: however far");
  describe_random_numbers(params);
  if (!(distance >= 0)) params.error("maxdistance", "the distance must not be negative");
  params.finish();
  expect_enough(render.memory, {.pixels = SummedIterations::bytes(render.crop.count(), scene.frame_count())});
  const Hemisphere hemisphere{by_cosine, distance > 0 ? distance : kInfinity};
  return std::make_unique<AmbientOcclusion>(iterations, hemisphere, scene.frame_count(), render);
}

}  // namespace dspm
