// Integrator "photonmap" "integer photons" 1000000 "integer causticphotons" 1000000 "integer nearest" 100
//
// Two-pass photon mapping [Jensen 1996] for all frames together: a map of caustic photons (light, smooth lobes, rough lobe)
// and a global one are made once, or for each iteration while the shutter is open; every iteration then traces one more camera
// path per pixel, with direct light by shadow rays, caustics from their map, and the rest from the global map, by default at the
// hit point itself, or through final gather rays, which scatter at most four times off smooth lobes. Biased: the maps' blur
// remains.
// Parameters: see make_photonmap below.
#include <fmt/format.h>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/common_params.h"
#include "dspm/integrators/guiding/emission_of_file.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/max_depth.h"
#include "dspm/integrators/photons/final_gather.h"
#include "dspm/integrators/photons/gather_beams.h"
#include "dspm/integrators/photons/hidden_light.h"
#include "dspm/integrators/photons/medium_photons.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/integrators/summing_integrator.h"
#include "dspm/integrators/tiles.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

struct PhotonMapSettings {
  int iterations = 256;
  int photons = 300000, caustic_photons = 300000;  // paths
  int nearest = 100;
  float radius = 0, caustic_radius = 0;  // 0: a fraction of the scene's
  int final_gather = 0;                  // rays per hit point; 0: none
  int max_depth = 8;
  float least_alpha = 0.25f;
  bool guided = true;  // photons start where they are found; else by the lights' power
};

constexpr float kRadiusShareOfScene = 0.05f, kCausticRadiusShareOfScene = 0.0125f;

HitPointSettings hit_point_settings(const PhotonMapSettings& s) {
  return {.max_depth = s.max_depth,
          .least_alpha = s.least_alpha,
          .sample_direct = true,
          .light_media = true,
          .keep_bsdf = s.final_gather > 0};
}

/// A final gather ray needs all incident light; without it, direct light and caustics are estimated separately.
PhotonSettings global_settings(const PhotonMapSettings& s, const RenderSettings& render, bool is_rgb) {
  return {.seed = render.seed,
          .independent_numbers = render.independent_numbers,
          .stream = Stream::photon,
          .max_depth = s.max_depth,
          .least_alpha = s.least_alpha,
          .kinds = s.final_gather > 0 ? kAllPhotons : kDiffusePhotons,
          .rays_light_media = true,
          .own_wavelengths = is_rgb};
}
PhotonSettings caustic_settings(const PhotonMapSettings& s, const RenderSettings& render, bool is_rgb) {
  return {.seed = render.seed,
          .independent_numbers = render.independent_numbers,
          .stream = Stream::caustic_photon,
          .max_depth = s.max_depth,
          .least_alpha = s.least_alpha,
          .kinds = kCausticPhotons,
          .hidden = true,
          .own_wavelengths = is_rgb};
}

/// Photon settings whose guides are those in `learned`.
struct GuidedPhotons {
  PhotonSettings settings;
  std::shared_ptr<const LearnedEmission> learned;

  GuidedPhotons(const Scene& scene, const PhotonSettings& of, float radius, const PhotonMapSettings& s,
                const RenderSettings& render, int photons, bool guided, Statistics& statistics)
      : settings(of), learned(emission_of_file(scene, render, of, within(radius, s), photons, guided, statistics)) {
    settings.guides = &learned->guides;
  }
  static HitPointSettings within(float radius, const PhotonMapSettings& s) {
    HitPointSettings settings = hit_point_settings(s);
    settings.radius = radius;
    return settings;
  }
};

float global_radius(const PhotonMapSettings& s, const Scene& scene) {
  return s.radius > 0 ? s.radius : kRadiusShareOfScene * scene.radius;
}
float caustic_radius(const PhotonMapSettings& s, const Scene& scene) {
  return s.caustic_radius > 0 ? s.caustic_radius : kCausticRadiusShareOfScene * scene.radius;
}

/// Returns the global photons. They have guides only without final gathering: its rays find photons where no camera
/// path does.
GuidedPhotons global_photons(const Scene& scene, const PhotonMapSettings& s, RenderSettings render,
                             Statistics& statistics) {
  render.count_found &= s.final_gather == 0;
  return {scene,
          global_settings(s, render, scene.palette->is_rgb()),
          global_radius(s, scene),
          s,
          render,
          s.photons,
          s.guided && s.final_gather == 0,
          statistics};
}
GuidedPhotons caustic_photons(const Scene& scene, const PhotonMapSettings& s, const RenderSettings& render,
                              Statistics& statistics) {
  return {scene,
          caustic_settings(s, render, scene.palette->is_rgb()),
          caustic_radius(s, scene),
          s,
          render,
          s.caustic_photons,
          s.guided,
          statistics};
}

MemoryNeeds needs_of(const PhotonMapSettings& s, const Scene& scene, const RenderSettings& render) {
  Statistics not_counted;
  const GuidedPhotons global = global_photons(scene, s, render, not_counted),
                      caustic = caustic_photons(scene, s, render, not_counted);
  const LightGroups groups(scene, render.outputs);
  const double photons = bytes_a_photon_path(scene, global.settings, groups) * s.photons +
                         bytes_a_photon_path(scene, caustic.settings, groups) * s.caustic_photons;
  MemoryNeeds needs;
  needs.pixels = SummedIterations::bytes(render.crop.count(), scene.frame_count(), groups.count(), has_catchers(scene));
  needs.hit_points = hit_point_bytes(scene, render, hit_point_settings(s));
  needs.photons = static_cast<std::size_t>(photons) + global.learned->guides.bytes() + caustic.learned->guides.bytes();
  needs.learning = std::max(global.learned->bytes_while_learning, caustic.learned->bytes_while_learning);
  return needs;
}

class PhotonMapper final : public SummingIntegrator {
  enum Step { kPhotonMaps, kHitPoints, kGather };

 public:
  PhotonMapper(const PhotonMapSettings& settings, const Scene& scene, const RenderSettings& render)
      : SummingIntegrator(scene, render, statistics_at_start(settings, scene, render)),
        settings_(settings),
        render_(render),
        global_(LightGroups(scene, render.outputs)),
        caustic_(global_.groups()),
        hidden_(global_.groups()) {
    global_how_ = {settings.nearest, global_radius(settings, scene), settings.photons};
    caustic_how_ = {settings.nearest, caustic_radius(settings, scene), settings.caustic_photons};
  }

  int iterations() const override { return settings_.iterations; }
  std::string settings() const override {
    return fmt::format("{} photons in the global map, {} in the caustic map, {} final gather rays", settings_.photons,
                       settings_.caustic_photons, settings_.final_gather);
  }

  void iterate(const Iteration& iteration) override {
    const auto number = static_cast<std::uint64_t>(iteration.number);
    done_.advance([&](SeenLightSums& sums, Statistics& statistics) {
      // Maps show one time of the shutter, and light of some wavelengths: iterations that have their own have own maps.
      const bool has_own = iteration.delay || !iteration.scene.palette->is_rgb();
      if (!has_maps_ || has_own) make_maps(iteration.scene, has_own ? number : 0, has_own, statistics);
      trace_camera_paths(iteration.scene, number, statistics);
      gather_tiles(iteration.scene, number, sums, statistics);
    });
    has_maps_ = true;
  }

 private:
  static Statistics statistics_at_start(const PhotonMapSettings& settings, const Scene& scene,
                                        const RenderSettings& render) {
    Statistics statistics;
    statistics.steps = {{"photon maps"}, {"hit points"}, {"gather"}};
    statistics.energy.resize(static_cast<std::size_t>(scene.frame_count()));
    if (render.learn_at_once)
      global_photons(scene, settings, render, statistics), caustic_photons(scene, settings, render, statistics);
    return statistics;
  }

  struct TileCounts {
    GatherCounts gather;
    PathCounts paths;
  };

  void make_maps(const Scene& scene, std::uint64_t iteration, bool are_own, Statistics& statistics) {
    const StepTimer timer(statistics.steps[kPhotonMaps]);
    const auto trace = [&](const GuidedPhotons& how, int photons) {
      auto traces = trace_photons(scene, how.settings, iteration, 0, photons, {});
      if (are_own || statistics.iterations == 0) account(traces, statistics);  // else they are only rebuilt
      return traces;
    };
    const auto build = [&](auto& map, const std::vector<PhotonTrace>& traces, const RadianceEstimate& how) {
      map.build(traces, scene.frame_count(), how.radius / 4);
    };
    global_traces_ = trace(global_photons(scene, settings_, render_, statistics), settings_.photons);
    build(global_, global_traces_, global_how_);
    in_media_.build(global_traces_);
    for (PhotonTrace& t : global_traces_) t.photons = {};  // the map has copies of these
    caustic_traces_ = trace(caustic_photons(scene, settings_, render_, statistics), settings_.caustic_photons);
    build(caustic_, caustic_traces_, caustic_how_);
    build(hidden_, caustic_traces_, caustic_how_);
    for (PhotonTrace& t : caustic_traces_) t.photons = {}, t.hidden = {};  // the maps have copies of these
  }

  void trace_camera_paths(const Scene& scene, std::uint64_t iteration, Statistics& statistics) {
    const StepTimer timer(statistics.steps[kHitPoints]);
    HitPointSettings settings = hit_point_settings(settings_);
    settings.radius = caustic_how_.radius;  // of beams
    tiles_ = trace_hit_points(scene, render_, settings, iteration, std::move(tiles_));
    account(tiles_, statistics);
  }

  void gather_tile(const Scene& scene, const HitPointTile& tile, std::uint64_t iteration, SeenLightSums& sums,
                   TileCounts& counts) const {
    const auto add = [&](const HitPoint& hit, FrameSet frames, const Spectrum& radiance, int group) {
      const SeenLight light{frames, tile.palette->seen(radiance), hit.pixel, -1, hit.caught};
      if (group == LightGroups::kNone)
        sums.add(light);
      else if (!hit.caught)
        sums.add_to_part(light, group);
    };
    const auto estimate = [&](const HitPoint& hit, const PhotonMap& map, const RadianceEstimate& how) {
      estimate_radiance(
          hit, tile.scattering_of(hit), map, how, counts.gather,
          [&](FrameSet frames, const Spectrum& radiance, int group) { add(hit, frames, radiance, group); });
    };
    FinalGather final_gather(scene, render_, {settings_.final_gather, settings_.least_alpha, settings_.max_depth},
                             global_, global_how_, counts.gather, counts.paths, add);
    for (const SeenLight& light : tile.seen) sums.add(light);
    for (const CameraBeam& beam : tile.beams) see_along(beam, tile, sums, counts.gather);
    for (const HitPoint& hit : tile.glossy) {
      if (tile.strip_of(hit) == nullptr)
        estimate(hit, hidden_.on_surfaces, caustic_how_);
      else
        see_on_curve(hit, tile, counts.gather, add);
    }
    for (const HitPoint& hit : tile.hit_points) {
      estimate(hit, caustic_, caustic_how_);
      if (settings_.final_gather == 0)
        estimate(hit, global_, global_how_);
      else
        final_gather.gather(hit, *tile.scattering_of(hit), iteration);
    }
  }

  /// Adds what media scatter along a beam, and its parts by groups of lights.
  void see_along(const CameraBeam& beam, const HitPointTile& tile, SeenLightSums& sums, GatherCounts& counts) const {
    const auto light_of = [&](FrameSet frames, const Spectrum& radiance) {
      return SeenLight{frames, tile.palette->seen(radiance) / static_cast<float>(settings_.photons), beam.pixel, -1,
                       beam.caught};
    };
    gather_beam(
        beam, tile, in_media_, 1, counts, [](int) { return true; },
        [&](FrameSet frames, const Spectrum& radiance) { sums.add(light_of(frames, radiance)); });
    gather_beam_by_group(beam, tile, in_media_, 1, sums.groups(),
                         [&](FrameSet frames, const Spectrum& radiance, int group) {
                           sums.add_to_part(light_of(frames, radiance), group);
                         });
  }

  /// Adds the photons within the largest radius: the nearest photons on a strip need not surround the point.
  template <class Add>
  void see_on_curve(const HitPoint& hit, const HitPointTile& tile, GatherCounts& counts, Add&& add) const {
    const float radius2 = caustic_how_.radius * caustic_how_.radius;
    const float size = kernel_size(radius2, static_cast<float>(caustic_how_.emitted));
    gather_hidden_by_group(hit, tile, hidden_, radius2, counts,
                           [&](const Strand*, FrameSet frames, SpectrumLanes flux, float, const auto& group) {
                             const Spectrum radiance = hit.throughput * flux.spectrum() / size;
                             add(hit, frames, radiance, LightGroups::kNone);
                             if (hidden_.on_surfaces.groups().count() > 0 && group() != LightGroups::kNone)
                               add(hit, frames, radiance, group());
                           });
  }

  void gather_tiles(const Scene& scene, std::uint64_t iteration, SeenLightSums& sums, Statistics& statistics) {
    const StepTimer timer(statistics.steps[kGather]);
    std::vector<TileCounts> counts(tiles_.size());
    parallel_for(static_cast<std::int64_t>(tiles_.size()), 1, [&](std::int64_t t) {
      const auto tile = static_cast<std::size_t>(t);
      gather_tile(scene, tiles_[tile], iteration, sums, counts[tile]);
    });
    std::vector<GatherCounts> gathers;
    for (const TileCounts& c : counts) statistics.camera.segments += c.paths.segments, gathers.push_back(c.gather);
    account(gathers, statistics);
    statistics.bytes = std::max(statistics.bytes, global_.bytes() + caustic_.bytes() + hidden_.bytes() +
                                                      in_media_.bytes() + bytes_of(global_traces_) +
                                                      bytes_of(caustic_traces_) + done_.bytes() + bytes_of(tiles_));
  }

  PhotonMapSettings settings_;
  RenderSettings render_;
  PhotonMap global_, caustic_;
  std::vector<PhotonTrace> global_traces_, caustic_traces_;
  MediumPhotons in_media_;  // they lie in the traces
  HiddenPhotons hidden_;    // on glossy lobes; those on curves lie in the traces
  bool has_maps_ = false;
  RadianceEstimate global_how_, caustic_how_;
  std::vector<HitPointTile> tiles_;
};

}  // namespace

std::unique_ptr<Integrator> make_photonmap(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  PhotonMapSettings s;
  params.alias("photonsperiteration", "photons");
  s.iterations = read_iterations(params, render, "camera paths per pixel");
  s.photons = params.integer("photons", s.photons, "", "photon paths for the global map, traced once");
  s.caustic_photons =
      params.integer("causticphotons", s.caustic_photons, "", "photon paths for the caustic map, traced once");
  s.nearest = params.integer("nearest", s.nearest, "", "photons per estimate; 0: all within the radius");
  s.radius = params.number(
      "radius", 0, "world units",
      "search radius in the global map: the maximum, or fixed if nearest is 0; 0: 5% of the scene's radius");
  s.caustic_radius =
      params.number("causticradius", 0, "world units", "the same for the caustic map; 0: 1.25% of the scene's radius");
  s.final_gather =
      params.integer("finalgather", 0, "", "final gather rays per camera path; 0: the global map is used directly");
  s.max_depth =
      params.integer("maxdepth", s.max_depth, "", "maximum number of bounces, for camera paths and for photon paths");
  s.least_alpha = params.number("gatheralpha", s.least_alpha, "GGX alpha",
                                "lobes at least this rough gather photons; smoother ones extend the path");
  s.guided = read_emission(params);
  describe_random_numbers(params);
  const auto demand = [&](bool holds, std::string_view name, const char* what) {
    if (!holds) params.error(name, what);
  };
  demand(s.photons > 0, "photons", "there must be at least one photon");
  demand(s.caustic_photons > 0, "causticphotons", "there must be at least one photon");
  demand(s.nearest == 0 || s.nearest >= 2, "nearest",
         "nearest must be 0 (all photons within the radius) or at least 2");
  demand(s.radius >= 0, "radius", "the radius must not be negative");
  demand(s.caustic_radius >= 0, "causticradius", "the radius must not be negative");
  demand(s.final_gather >= 0, "finalgather", "the number of rays must not be negative");
  demand(s.least_alpha > 0, "gatheralpha", "gatheralpha must be positive: nothing gathers on a mirror");
  if (s.final_gather > 0 && !scene.media.empty())
    params.error("finalgather", "final gather rays see no media", "leave it out: the global map is then used directly");
  check_max_depth(params, s.max_depth, 1);
  params.finish();
  if (render.memory > 0) expect_enough(render.memory, needs_of(s, scene, render));
  return std::make_unique<PhotonMapper>(s, scene, render);
}

}  // namespace dspm
