#include "dspm/integrators/methods/progressive_settings.h"

#include <fmt/format.h>

#include "dspm/base/params/params.h"
#include "dspm/integrators/common_params.h"
#include "dspm/integrators/guiding/emission_of_file.h"
#include "dspm/integrators/max_depth.h"
#include "dspm/integrators/photons/shares_of_light.h"
#include "dspm/integrators/pixel_count.h"
#include "dspm/integrators/waves/devices.h"
#include "dspm/integrators/waves/wave_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

ProgressiveSettings read_progressive_settings(ParamReader& params, const RenderSettings& render) {
  ProgressiveSettings s;
  params.alias("photonsperiteration", "photons");
  params.former_name("mixture", "sharepaths");
  s.iterations = read_iterations(params, render, "number of iterations");
  s.photons = params.integer("photons", s.photons, "", "photon paths per iteration; also named photonsperiteration");
  s.hit_point.radius =
      params.number("radius", 0, "world units",
                    "initial search radius; 0: four pixel spacings at the hit point, at most 5% of the scene's radius");
  s.alpha = params.number("alpha", s.alpha, "", "fraction of the new photons kept as the radius shrinks, in (0, 1)");
  const int max_depth =
      params.integer("maxdepth", 8, "", "maximum number of bounces, for camera paths and for photon paths");
  s.kz11 = params.choice("estimator", "kz11", {"hj09", "kz11"},
                         "hj09: each pixel shrinks its own radius; kz11: the radius depends only on the iteration") ==
           "kz11";
  const std::string direct =
      params.choice("direct", "both", {"both", "photons", "sampled"},
                    "direct light by photons, by shadow rays from the hit points, or by both, each weighted by how "
                    "well it finds the light");
  const std::string indirect = params.choice(
      "indirect", "auto", {"auto", "photons", "paths"},
      "light that rough surfaces scatter to others by photons, or by camera paths that go on from hit points and leave "
      "only caustics to photons; auto: sppm by photons, dsppm by what has less noise in the same time, with as many "
      "photons as pay or none, unless direct is photons");
  s.guided = read_emission(params);
  const float least_alpha = params.number("gatheralpha", 0.25f, "GGX alpha",
                                          "lobes at least this rough gather photons; smoother ones extend the path");
  const bool share_paths =
      params.flag("sharepaths", true,
                  "frames that differ only in appearance or light share paths, each with a weight; false: they part");
  describe_random_numbers(params);
  const auto demand = [&](bool holds, std::string_view name, const char* what) {
    if (!holds) params.error(name, what);
  };
  demand(s.photons > 0 || s.photons == -1, "photons", "there must be at least one photon per iteration");
  demand(s.hit_point.radius >= 0, "radius", "the radius must not be negative");
  demand(s.alpha > 0 && s.alpha < 1, "alpha", "alpha must lie between 0 and 1");
  demand(least_alpha > 0, "gatheralpha", "gatheralpha must be positive: nothing gathers on a mirror");
  if (indirect == "paths" && !s.kz11)
    params.error("indirect",
                 "camera paths that go on need estimator \"kz11\": with \"hj09\" a pixel has one hit point");
  check_max_depth(params, max_depth, 1);
  params.finish();
  if (s.photons == -1) s.photons = pixel_count(render);  // pbrt's default
  s.photon.seed = render.seed, s.photon.independent_numbers = render.independent_numbers;
  s.traced = s.photons;
  s.photon.max_depth = s.hit_point.max_depth = max_depth;
  s.photon.least_alpha = s.hit_point.least_alpha = least_alpha;
  s.photon.kinds = direct == "sampled" ? kCausticPhotons | kDiffusePhotons : kAllPhotons;
  s.photon.share_paths = s.hit_point.share_paths = share_paths;
  s.hit_point.sample_direct = direct != "photons";
  s.hit_point.light_media = s.photon.rays_light_media = s.hit_point.sample_direct;
  s.hit_point.photons_as_well = s.photon.rays_tell = direct == "both";
  s.photon.hidden = true;
  s.may_choose = indirect == "auto" && s.kz11 && direct != "photons";
  if (indirect == "paths") s.hit_point = going_on(s.hit_point), s.photon = without_diffuse(s.photon);
  return s;
}

void expect_photons_in_media(ParamReader& params, const ProgressiveSettings& settings, const Scene& scene) {
  if (settings.hit_point.go_on && !scene.media.empty())
    params.error("indirect", "\"indirect\" \"paths\" finds no light that media scatter",
                 "leave it out: in scenes with media photons bring all indirect light");
}

void choose_device(ParamReader& params, ProgressiveSettings& settings, const Scene& scene,
                   const RenderSettings& render) {
  if (render.device == Device::cpu || scene.accel == nullptr) return;
  const std::string no_gpu = render.device == Device::waves ? "" : why_no_gpu();
  const std::string no_waves = why_not_in_waves(scene, settings.photon);
  if (render.device == Device::automatic) {
    settings.why_not_gpu = no_gpu.empty() ? no_waves : no_gpu;
    if (settings.why_not_gpu.empty()) settings.device = Device::gpu;
    return;
  }
  if (!no_gpu.empty()) params.error("", "there is no GPU to render on: " + no_gpu, "take --device auto, or leave it out");
  if (!no_waves.empty())
    params.error("", "photons of this scene cannot be traced in waves: " + no_waves, "leave out --device");
  settings.device = render.device;
}

namespace {

std::string in_words(Device device, const std::string& why_not_gpu) {
  if (device == Device::gpu) return ", paths on a GPU";
  if (device == Device::waves) return ", paths in waves";
  return why_not_gpu.empty() ? "" : ", paths on the CPU: " + why_not_gpu;
}

}  // namespace

std::string in_words(const ProgressiveSettings& s) {
  const float radius = s.hit_point.radius;
  return fmt::format(
      "{}{} photons per iteration, initial radius {}, estimator {}, gathering at GGX alpha {} and above{}",
      s.may_choose ? "at most " : "", s.photons, radius > 0 ? fmt::format("{}", radius) : "from the pixel footprint",
      s.kz11 ? "kz11" : "hj09", s.photon.least_alpha, in_words(s.device, s.why_not_gpu));
}

}  // namespace dspm
