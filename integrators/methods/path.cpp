// Integrator "path" "integer maxdepth" 65
//
// Path tracing with next event estimation, both ways of finding a light combined by the balance heuristic [Veach 1997].
// The reference for all others. It cannot find light of point, spot or distant lights that arrives via specular
// surfaces; everything else is unbiased. An iteration is one path per pixel; frames share paths until they part.
//
//   iterations  paths per pixel                   the sampler's pixelsamples, else 256
//   maxdepth    bounces                           5
//   indirect    also light that rough surfaces have scattered more than once   true
#include <fmt/format.h>

#include "dspm/base/params/params.h"
#include "dspm/integrators/caught_light.h"
#include "dspm/integrators/common_params.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/max_depth.h"
#include "dspm/integrators/methods/cut_light.h"
#include "dspm/integrators/methods/path_tracer.h"
#include "dspm/integrators/methods/tile_traced.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/integrators/transport/missed_light.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

/// Takes what the tracer finds, however far away.
struct Sums {
  SeenLightSums& sums;
  void add(const SeenLight& light, int /*scatterings*/) { sums.add(light); }
};

class Path final : public TileTraced {
 public:
  Path(int iterations, const PathLimits& limits, const Scene& scene, const RenderSettings& render)
      : TileTraced(iterations, scene, render, statistics_at_start(scene, render)), limits_(limits) {}

  std::string settings() const override {
    return fmt::format("one path per pixel and iteration, maxdepth {}{}", limits_.max_depth,
                       limits_.indirect ? "" : ", direct light only");
  }

 private:
  static Statistics statistics_at_start(const Scene& scene, const RenderSettings& render) {
    Statistics statistics;
    statistics.steps = {{"paths"}};
    statistics.cut_light = no_cut_light(scene, render);
    return statistics;
  }

  void trace(const Iteration& iteration, SeenLightSums& sums, Statistics& statistics) const override {
    Sums out{sums};
    trace_pixels(iteration, statistics, [&](const Scene& scene) { return PathTracer(scene, render(), limits_, out); });
    count_cut_light(iteration.scene, render(), limits_, static_cast<std::uint64_t>(iteration.number), statistics);
  }

  PathLimits limits_;
};

}  // namespace

std::unique_ptr<Integrator> make_path(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  const int iterations = read_iterations(params, render, "paths per pixel");
  const int max_depth = params.integer("maxdepth", 5, "", "maximum number of bounces");
  const bool indirect =
      params.flag("indirect", true, "light that rough surfaces have scattered more than once, too; false: direct only");
  describe_random_numbers(params);
  params.choice("lightsampler", "power", {"power", "bvh", "uniform", "exhaustive"},
                "accepted for pbrt compatibility; dspm samples all lights, or a few of many");
  if (params.flag("regularize", false, "accepted for pbrt compatibility"))
    params.diagnostics().note(params.where("regularize"),
                              "paths are not regularized: the image has the caustics that pbrt blurs, and their noise");
  if (const std::string missed = missed_light(scene); !missed.empty())
    params.diagnostics().note(params.where(), missed,
                              "dsppm and vcm find it, and path finds that of a small sphere or disk in its place");
  check_max_depth(params, max_depth, 0);
  params.finish();
  const int groups = LightGroups(scene, render.outputs).count();
  const std::size_t sums =
      SummedIterations::bytes(render.crop.count(), scene.frame_count(), groups, has_catchers(scene));
  expect_enough(render.memory, {.pixels = sums + cut_light_bytes(scene, render)});
  return std::make_unique<Path>(iterations, PathLimits{max_depth, indirect}, scene, render);
}

}  // namespace dspm
