// Integrator "vcm" "integer photons" 300000 "bool connect" true "bool merge" true
//
// Vertex connection and merging [Georgiev et al. 2012; Hachisuka et al. 2012] of all frames together: bidirectional
// path tracing and photon mapping in one estimate, weighted by the balance heuristic. A camera path hits lights, sends
// shadow rays to them, is connected to the vertices of one light path and merged with those of all that lie within a
// radius; light paths are connected to the camera. Light paths are traced once for all frames that share them, a
// connection is one shadow ray for all frames that hold both ends, and each frame has the weights that it has alone.
// Without "merge" it is bidirectional path tracing, which is unbiased; without "connect" as well, path tracing and
// light tracing. The radius shrinks as kz11's does [Knaus and Zwicker 2011] and is the same everywhere.
//
//   iterations    paths per pixel                         the sampler's pixelsamples, else 256
//   photons       light paths per iteration               -1: one per pixel
//   maxdepth      scatterings of a whole path             8
//   radius        initial radius of merging               0: a pixel spacing at what half of the pixels see
//   alpha         how slowly it shrinks                   0.75
//   connect       vertices of both kinds of paths         true
//   merge         vertices of both within the radius      true
//   lighttracing  light paths' vertices with the camera   true
//   emission      where light paths start                 guided; or power
//   sharepaths    frames that scatter alike share paths   true
#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/integrators/common_params.h"
#include "dspm/integrators/guiding/emission_of_file.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/integrators/guiding/pilot_pixels.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/max_depth.h"
#include "dspm/integrators/methods/cut_light.h"
#include "dspm/integrators/methods/estimator.h"
#include "dspm/integrators/methods/vcm/camera_subpaths.h"
#include "dspm/integrators/methods/vcm/light_subpaths.h"
#include "dspm/integrators/methods/vcm/light_vertex_map.h"
#include "dspm/integrators/methods/vcm/vcm_pass.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/pixel_count.h"
#include "dspm/integrators/summing_integrator.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

/// Returns a part of the median of the radii that dsppm begins with, over frames of the whole file: whichever frames
/// are rendered, all their light paths have the same weights. Merging pays where connections fail, and costs
/// everywhere.
float usual_radius(const Scene& sample, const RenderSettings& render, int max_depth) {
  constexpr float kPart = 0.25f;
  constexpr double kPilotPixels = 4096;
  const HitPointSettings settings{.max_depth = max_depth, .share_paths = true};
  const float median = median_radius(PilotPixels(render, kPilotPixels).trace(sample, settings));
  return median > 0 ? kPart * median : 0.01f * sample.radius;
}

bool needs_light_paths(const VcmSettings& settings) { return settings.connect || settings.merge || settings.sight; }

VcmPass pass_of(const VcmSettings& settings, const Scene& scene, const RenderSettings& render, std::uint64_t iteration,
                float radius, const EmissionGuides* guides) {
  const auto paths = static_cast<float>(settings.photons);
  constexpr float kRadiiInMedia = 4;  // there, vertices lie apart in three dimensions
  const float in_media = kRadiiInMedia * radius;
  VcmWays ways;
  if (settings.merge) {
    ways.merging = paths * kPi * radius * radius;
    ways.merging_in_media = paths * (4 * kPi / 3) * in_media * in_media * in_media;
  }
  if (settings.sight) ways.sighting = paths;
  ways.connecting = settings.connect;
  return {scene, render, settings, iteration, radius, in_media, ways, guides, scene.nm_of(render.seed, iteration)};
}

/// Learns where light paths start that shadow rays cannot replace.
std::shared_ptr<const LearnedEmission> learned_emission(const VcmSettings& settings, const Scene& scene,
                                                        const RenderSettings& render, Statistics& statistics) {
  PhotonSettings photon;
  photon.seed = render.seed, photon.independent_numbers = render.independent_numbers;
  photon.max_depth = settings.max_depth;
  photon.kinds = kCausticPhotons | kDiffusePhotons, photon.hidden = photon.are_light_paths = true;
  const HitPointSettings hit_point{.max_depth = settings.max_depth, .sample_direct = true};
  auto learned = emission_of_file(scene, render, photon, hit_point, settings.photons, settings.guided, statistics);
  expect_enough(render.memory, {.learning = learned->bytes_while_learning});
  return learned;
}

/// Returns the bytes of the light paths and their map, from a small sample of iteration 0.
std::size_t light_path_bytes(const VcmSettings& settings, const Scene& scene, const RenderSettings& render) {
  constexpr int kPaths = 4096;
  constexpr double kSlack = 1.25, kWithCells = 1.5;  // chunks differ; a few vertices have few cells
  VcmSettings few = settings;
  few.photons = std::min(few.photons, kPaths);
  LightSubpaths sample;
  Statistics not_counted;
  const auto learned = learned_emission(settings, scene, render, not_counted);
  sample.trace(pass_of(few, scene, render, 0, settings.radius, &learned->guides));
  LightVertexMap map;
  if (settings.merge) map.build(sample.traces(), scene.frame_count(), {2 * scene.radius, 2 * scene.radius});
  const double bytes = static_cast<double>(sample.bytes()) + kWithCells * static_cast<double>(map.bytes());
  return static_cast<std::size_t>(kSlack * bytes / few.photons * settings.photons);
}

class Vcm final : public SummingIntegrator {
  enum Step { kEmission, kLightPaths, kMap, kCameraPaths };

 public:
  /// `sample` is the sample of the file, or null if none has been made.
  Vcm(const VcmSettings& settings, const Scene& scene, const RenderSettings& render,
      std::shared_ptr<const Scene> sample)
      : SummingIntegrator(scene, render, statistics_at_start(scene, render)),
        settings_(settings),
        render_(render),
        sample_(std::move(sample)) {}

  int iterations() const override { return settings_.iterations; }
  std::string settings() const override {
    return fmt::format("{} light paths per iteration, {}connected, {}merged{}, maxdepth {}", settings_.photons,
                       settings_.connect ? "" : "not ", settings_.merge ? "" : "not ",
                       settings_.merge ? fmt::format(" within {} at first", settings_.radius) : "",
                       settings_.max_depth);
  }

  void iterate(const Iteration& iteration) override {
    const Scene& scene = iteration.scene;
    radius_.go_to(iteration.number, settings_.alpha);
    done_.advance([&](SeenLightSums& sums, Statistics& statistics) {
      if (learned_ == nullptr) learn(scene, statistics);
      const VcmPass pass = pass_of(settings_, scene, render_, static_cast<std::uint64_t>(iteration.number),
                                   radius_.of(settings_.radius), &learned_->guides);
      if (needs_light_paths(settings_)) trace_light_subpaths(pass, sums, statistics);
      if (settings_.merge) build_map(pass, statistics);
      const StepTimer timer(statistics.steps[kCameraPaths]);
      trace_camera_subpaths(pass, light_, map_, sums, statistics);
      count_cut_light(scene, render_, {settings_.max_depth, true}, pass.iteration, statistics);
      statistics.bytes = std::max(statistics.bytes, done_.bytes() + light_.bytes() + map_.bytes());
    });
  }

 private:
  static Statistics statistics_at_start(const Scene& scene, const RenderSettings& render) {
    Statistics statistics;
    statistics.steps = {{"emission"}, {"light paths"}, {"map"}, {"camera paths"}};
    statistics.cut_light = no_cut_light(scene, render);
    return statistics;
  }

  void learn(const Scene& scene, Statistics& statistics) {
    const StepTimer timer(statistics.steps[kEmission]);
    VcmSettings settings = settings_;
    settings.guided &= needs_light_paths(settings);
    learned_ = learned_emission(settings, scene, render_, statistics);
    sample_.reset();
  }

  void trace_light_subpaths(const VcmPass& pass, SeenLightSums& sums, Statistics& statistics) {
    const StepTimer timer(statistics.steps[kLightPaths]);
    light_.trace(pass);
    light_.account(statistics);
    std::vector<std::span<const Splat>> splats;
    for (const LightTrace& trace : light_.traces()) splats.emplace_back(trace.splats);
    add_splats(splats, render_, sums);
  }

  void build_map(const VcmPass& pass, Statistics& statistics) {
    const StepTimer timer(statistics.steps[kMap]);
    map_.build(light_.traces(), pass.scene.frame_count(), {pass.radius, pass.radius_in_media});
  }

  VcmSettings settings_;
  RenderSettings render_;
  std::shared_ptr<const Scene> sample_;  // until learn(), which would make it again
  IterationRadius radius_;
  std::shared_ptr<const LearnedEmission> learned_;  // null before the first iteration
  LightSubpaths light_;
  LightVertexMap map_;
};

VcmSettings read_settings(ParamReader& params, const RenderSettings& render) {
  VcmSettings s;
  params.alias("photonsperiteration", "photons");
  s.iterations = read_iterations(params, render, "paths per pixel");
  s.photons = params.integer("photons", -1, "", "light paths per iteration; -1: one per pixel of the image");
  s.max_depth = params.integer("maxdepth", s.max_depth, "", "maximum number of bounces of a whole path");
  s.radius = params.number("radius", 0, "world units",
                           "initial radius of merging; 0: a pixel spacing at what half of the pixels see");
  s.alpha = params.number("alpha", s.alpha, "", "how slowly the radius shrinks, in (0, 1)");
  s.connect = params.flag("connect", true, "connects vertices of camera paths to those of light paths");
  s.merge = params.flag(
      "merge", true,
      "merges vertices of camera paths with those of light paths within the radius; if they are connected as "
      "well, only where light comes from a mirror or a narrow lobe");
  s.sight = params.flag("lighttracing", true, "connects vertices of light paths to the camera");
  s.guided = read_emission(params);
  s.share_paths = params.flag("sharepaths", true,
                              "frames that differ only in appearance or light share paths, each with a weight; false: "
                              "they part");
  describe_random_numbers(params);
  const auto demand = [&](bool holds, std::string_view name, const char* what) {
    if (!holds) params.error(name, what);
  };
  demand(s.photons > 0 || s.photons == -1, "photons", "there must be at least one light path per iteration");
  demand(s.radius >= 0, "radius", "the radius must not be negative");
  demand(s.alpha > 0 && s.alpha < 1, "alpha", "alpha must lie between 0 and 1");
  check_max_depth(params, s.max_depth, 0);
  params.finish();
  if (s.photons == -1) s.photons = pixel_count(render);
  s.sight &= render.jitter;  // no light path arrives at the centres of pixels
  return s;
}

}  // namespace

std::unique_ptr<Integrator> make_vcm(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  VcmSettings settings = read_settings(params, render);
  std::shared_ptr<const Scene> sample;
  if (settings.merge && settings.radius == 0) {
    if (render.file != nullptr) sample = render.file->scene(scene);
    settings.radius = usual_radius(sample != nullptr ? *sample : scene, render, settings.max_depth);
  }
  if (render.memory > 0)
    expect_enough(render.memory,
                  {.pixels = SummedIterations::bytes(render.crop.count(), scene.frame_count(),
                                                     LightGroups(scene, render.outputs).count(), has_catchers(scene)) +
                             cut_light_bytes(scene, render),
                   .photons = light_path_bytes(settings, scene, render)});
  return std::make_unique<Vcm>(settings, scene, render, std::move(sample));
}

}  // namespace dspm
