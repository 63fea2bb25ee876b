#include "dspm/integrators/guiding/emission_of_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "dspm/base/system/activity.h"
#include "dspm/integrators/guiding/learn_direct.h"
#include "dspm/integrators/guiding/learn_emission.h"
#include "dspm/integrators/guiding/learn_indirect.h"
#include "dspm/integrators/guiding/pilot_paths.h"
#include "dspm/integrators/photons/shares_of_light.h"

namespace dspm {
namespace {

class Learning {
 public:
  Learning(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
           const HitPointSettings& hit_point, int photons, bool guided)
      : sample_(sample),
        render_(render),
        photon_(photon),
        hit_point_(hit_point),
        photons_(photons),
        guided_(guided),
        direct_(hit_point.photons_as_well) {}

  /// Learns how photons bring all light.
  LearnedEmission all() {
    LearnedEmission result = start(photon_, hit_point_);
    if (direct_) result.direct = direct(result.guides);
    return finished(std::move(result));
  }

  /// Learns how much of the light photons should bring. Guides are learned only for photons that may be worth it.
  LearnedEmission best() {
    const PossibleCaustics caustics = possible_caustics(sample_, photon_.least_alpha);
    LearnedEmission few;
    if (caustics != PossibleCaustics::none) few = of_caustics();
    const LightWays ways(sample_, render_, photon_, hit_point_, photons_, caustics, few.guides);
    const LightWay by_camera_paths = ways.by_camera_paths();
    const auto pays_less = [&](const LightWay& way) { return by_camera_paths.merit < way.merit; };
    if (!pays_less(ways.by_photons_at_best(direct_ ? direct({}) : LearnedDirect()))) {
      LearnedEmission by_photons = all();
      const LightWay way = ways.by_photons(by_photons.guides, by_photons.direct);
      if (!pays_less(way)) return as_many(std::move(by_photons), way.photons);
    }
    few.bring = by_camera_paths.bring, few.traced = by_camera_paths.photons;
    if (few.bring == PhotonsBring::nothing) few.guides = {}, few.report = {};
    return finished(std::move(few));
  }

 private:
  /// Learns where caustics start. If hardly any are found, a light's own photons lead to them.
  LearnedEmission of_caustics() {
    constexpr double kEnoughFound = 0.02;
    LearnedEmission alone = start(caustics_alone(photon_), going_on(hit_point_));
    if (alone.report.share_found() > kEnoughFound) return alone;
    return start(without_diffuse(photon_), going_on(hit_point_));
  }

  LearnedEmission start(const PhotonSettings& photon, const HitPointSettings& hit_point) {
    LearnedEmission result;
    PilotPaths pilot;
    if (guided_)
      result.guides = learn_emission(sample_, render_, photon, hit_point, pilot);
    else if (render_.count_found)
      count_found(sample_, render_, photon, hit_point, pilot);
    bytes_ = std::max(bytes_, pilot.bytes);
    if (pilot.rounds > 0) result.report = report_of(pilot, sample_, photon, result.guides, guided_);
    return result;
  }

  /// Fewer photons share direct light otherwise.
  LearnedEmission as_many(LearnedEmission by_photons, std::int64_t photons) {
    if (photons == photons_) return by_photons;
    photons_ = by_photons.traced = by_photons.report.traced = photons;
    if (direct_) by_photons.direct = direct(by_photons.guides);
    return by_photons;
  }

  LearnedDirect direct(const EmissionGuides& guides) {
    std::size_t bytes = 0;
    LearnedDirect learned = learn_direct(sample_, render_, hit_point_, photons_, guides, bytes);
    bytes_ = std::max(bytes_, bytes);
    return learned;
  }

  LearnedEmission finished(LearnedEmission result) const {
    result.bytes_while_learning = bytes_;
    result.lights = static_cast<std::int32_t>(sample_.lights.size());
    result.report.bring = result.bring, result.report.traced = result.traced;
    if (result.bring == PhotonsBring::nothing)
      result.report.photons = "photons", result.report.start = EmissionReport::Start::needs_none;
    return result;
  }

  const Scene& sample_;
  const RenderSettings& render_;
  const PhotonSettings& photon_;
  const HitPointSettings& hit_point_;
  std::int64_t photons_;
  bool guided_, direct_;
  std::size_t bytes_ = 0;
};

}  // namespace

bool read_emission(ParamReader& params) {
  return params.choice("emission", "guided", {"guided", "power"},
                       "guided: photons start where pilot paths were found by the camera; power: in proportion to the "
                       "lights' power") == "guided";
}

std::shared_ptr<const LearnedEmission> emission_of_file(const Scene& scene, const RenderSettings& render,
                                                        const PhotonSettings& photon, const HitPointSettings& hit_point,
                                                        int photons, bool guided, Statistics& statistics,
                                                        bool may_choose) {
  const bool both = hit_point.photons_as_well;
  if (render.file == nullptr || !(guided || both || may_choose || render.count_found))
    return std::make_shared<const LearnedEmission>();
  const std::string settings = fmt::format("{} {} {} {} {} {} {} {} {} {} {}", guided, both, may_choose,
                                           hit_point.go_on, photon.kinds, photon.max_depth, photon.least_alpha,
                                           photon.hidden, hit_point.max_depth, hit_point.least_alpha, hit_point.radius);
  if (!render.file->learns()) return render.file->earlier(settings, scene);
  if (guided) render.file->expect_known(settings, scene.lights.size());
  const auto learned = render.file->emission(settings, [&] {
    const Activity activity("learning where photons start");
    const std::shared_ptr<const Scene> sample = render.file->scene(scene);
    Learning learning(*sample, render, photon, hit_point, photons, guided);
    return may_choose ? learning.best() : learning.all();
  });
  if (learned->report.rounds > 0 || learned->bring == PhotonsBring::nothing) statistics.emission.put(learned->report);
  return learned;
}

}  // namespace dspm
