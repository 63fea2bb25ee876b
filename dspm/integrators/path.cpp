// Integrator "path" "integer maxdepth" 65
//
// Path tracing with next event estimation, both ways of finding a light combined by the balance heuristic [Veach 1997].
// The reference for all others. It cannot find light of point, spot or distant lights that arrives via specular
// surfaces; everything else is unbiased. An iteration is one path per pixel; frames share paths until they part.
//
//   iterations  paths per pixel                   the sampler's pixelsamples, else 256
//   maxdepth    bounces                           5
//   indirect    also light that rough surfaces have scattered more than once   true
#include "dspm/integrators/path.h"

#include <fmt/format.h>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/balance.h"
#include "dspm/integrators/branching_path.h"
#include "dspm/integrators/camera_path.h"
#include "dspm/integrators/caught_light.h"
#include "dspm/integrators/direct_light.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/max_depth.h"
#include "dspm/integrators/memory_needs.h"
#include "dspm/integrators/missed_light.h"
#include "dspm/integrators/summing_integrator.h"
#include "dspm/integrators/trace_tiles.h"
#include "dspm/math/frames.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"
#include "dspm/scene/scene.h"

namespace dspm {
namespace {

/// Where paths end.
struct Limits {
  int max_depth;
  bool indirect;  // else a path that a rough surface has scattered only looks for lights
};

class PixelTracer {
 public:
  PixelTracer(const Scene& scene, const RenderSettings& render, const Limits& limits, SeenLightSums& out)
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

  bool postpones(const CameraPath&, const HitPartition&) { return false; }

  void arrived(const CameraPath& arriving, const Vertex& vertex) {
    CameraPath path = arriving;
    path.arrive(scene_, vertex);
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      add_emission(path, vertex, frames);
      if (path.bounces >= limits_.max_depth || path.indirect) return;
      add_direct_light(path, vertex, frames, bsdf);
      CameraPath branch = path;
      branch.frames = frames, branch.travel(vertex.hit.t);
      scatter(branch, vertex, bsdf);
    });
  }

  void escaped(const CameraPath& path, FrameSet frames) {
    if (render_.transparent && path.bounces == 0) return;
    for_each_escape(scene_, frames, path.ray,
                    [&](FrameSet lit, const Rgb& radiance, const SceneLight& scene_light, const Light& light) {
                      add(path, lit, path.throughput * radiance * weight_of_escape(scene_, path, scene_light, light),
                          [&] { return light_element(scene_, scene_light); });
                    });
  }

  void lost(const CameraPath& path, FrameSet frames, const SceneElement& giver) { reject(path, frames, giver); }

  void add_emission(const CameraPath& path, const Vertex& vertex, FrameSet frames) {
    for_each_emission(scene_, vertex, frames, [&](FrameSet lit, const Rgb& radiance, const Light& light) {
      add(path, lit, path.throughput * radiance * weight_of_hit(scene_, path, vertex, light),
          [&] { return vertex.emitter_element(); });
    });
  }

  void add_direct_light(const CameraPath& path, const Vertex& vertex, FrameSet frames, const Bsdf& bsdf) {
    const auto scattered = [&](const LightSample& sample) {
      const LobeSet all = bsdf.all_lobes();
      const Rgb f = bsdf.evaluate(vertex.wo, sample.lit.wi, Transport::radiance, all);
      if (is_black(f) || !(sample.pdf_w > 0)) return f;
      return f * balance(sample.pdf_w, bsdf.pdf_w(vertex.wo, sample.lit.wi, Transport::radiance, all));
    };
    sample_direct_light(
        scene_, path, vertex, frames, counts_, scattered,
        [&](FrameSet lit, const Rgb& radiance, auto&& giver) { add(path, lit, path.throughput * radiance, giver); });
  }

  void scatter(CameraPath& path, const Vertex& vertex, const Bsdf& bsdf) {
    const int bounce = path.bounces;
    const auto sample = sample_bsdf(bsdf, path, vertex.wo, Transport::radiance, bsdf.all_lobes());
    if (!sample) return;
    extend(path, vertex, *sample);
    if (!is_finite(path.ray) || !is_finite(path.throughput))
      return reject(path, path.frames, vertex.material_element());
    path.leave(vertex, *sample);
    path.indirect = !limits_.indirect && !sample->specular;
    if (!is_black(path.throughput) &&
        survives(path, roulette_chance(path.throughput, path.eta_scale, bounce), path.random.number(bounce, kRoulette)))
      set_out(path);
  }

  void set_out(const CameraPath& path) {
    if (path.bounces < limits_.max_depth && !path.indirect) prefetch_direct_light(scene_, path);
    branches_.push(path);
  }

  /// `giver`: its source, the light if it is finite; else the one to blame.
  template <class WhoGave>
  void add(const CameraPath& path, FrameSet frames, const Rgb& radiance, WhoGave&& giver) {
    if (is_finite(radiance)) return out_.add({frames, radiance, path.pixel, light_of(giver()), path.caught});
    reject(path, frames, giver());
  }
  void reject(const CameraPath& path, FrameSet frames, const SceneElement& giver) {
    rejections_.add(giver, frames, path.pixel);
  }

  const Scene& scene_;
  const RenderSettings& render_;
  const Limits& limits_;
  SeenLightSums& out_;
  PathCounts counts_;
  Rejections rejections_;
  BranchingPath<CameraPath> branches_;
};

class Path final : public SummingIntegrator {
 public:
  Path(int iterations, const Limits& limits, const Scene& scene, const RenderSettings& render)
      : SummingIntegrator(scene, render, statistics_at_start()),
        iterations_(iterations),
        limits_(limits),
        render_(render) {}

  int iterations() const override { return iterations_; }
  std::string settings() const override {
    return fmt::format("one path per pixel and iteration, maxdepth {}{}", limits_.max_depth,
                       limits_.indirect ? "" : ", direct light only");
  }

  void iterate(int iteration, const Scene& scene) override {
    done_.advance([&](SeenLightSums& sums, Statistics& statistics) {
      trace_paths(scene, static_cast<std::uint64_t>(iteration), sums, statistics);
    });
  }

 private:
  static Statistics statistics_at_start() {
    Statistics statistics;
    statistics.steps = {{"paths"}};
    return statistics;
  }

  void trace_paths(const Scene& scene, std::uint64_t iteration, SeenLightSums& sums, Statistics& statistics) const {
    const StepTimer timer(statistics.steps[0]);
    trace_tiles(render_.crop, iteration, statistics, [&] { return PixelTracer(scene, render_, limits_, sums); });
  }

  int iterations_;
  Limits limits_;
  RenderSettings render_;
};

}  // namespace

std::unique_ptr<Integrator> make_path(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  const int iterations =
      params.integer("iterations", render.default_iterations, "",
                     "paths per pixel; 0: until stopped. The default is the sampler's pixelsamples, else 256");
  const int max_depth = params.integer("maxdepth", 5, "", "maximum number of bounces");
  const bool indirect =
      params.flag("indirect", true, "light that rough surfaces have scattered more than once, too; false: direct only");
  params.integer("seed", 0, "", "seed of the random numbers; the command line takes precedence");
  params.choice("lightsampler", "power", {"power", "bvh", "uniform", "exhaustive"},
                "accepted for pbrt compatibility; dspm samples all lights, or eight of many");
  if (params.flag("regularize", false, "accepted for pbrt compatibility"))
    params.diagnostics().note(params.where("regularize"),
                              "paths are not regularized: the image has the caustics that pbrt blurs, and their noise");
  if (const std::string missed = missed_light(scene); !missed.empty())
    params.diagnostics().note(params.where(), missed,
                              "dsppm and vcm find it, and path finds that of a small sphere or disk in its place");
  check_max_depth(params, max_depth, 0);
  if (iterations < 0) params.error("iterations", "the number of iterations must not be negative");
  params.finish();
  const int groups = LightGroups(scene, render.outputs).count();
  expect_enough(render.memory, {.pixels = SummedIterations::bytes(render.crop.count(), scene.frame_count(), groups,
                                                                  has_catchers(scene))});
  return std::make_unique<Path>(iterations, Limits{max_depth, indirect}, scene, render);
}

}  // namespace dspm
