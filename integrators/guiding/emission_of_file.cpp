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

namespace dspm {

bool read_emission(ParamReader& params) {
  return params.choice("emission", "guided", {"guided", "power"},
                       "guided: photons start where pilot paths were found by the camera; power: in proportion to the "
                       "lights' power") == "guided";
}

std::shared_ptr<const LearnedEmission> emission_of_file(const Scene& scene, const RenderSettings& render,
                                                        const PhotonSettings& photon, const HitPointSettings& hit_point,
                                                        int photons, bool guided, Statistics& statistics,
                                                        bool may_go_on) {
  const bool both = hit_point.photons_as_well;
  if (render.file == nullptr || !(guided || both || may_go_on || render.count_found))
    return std::make_shared<const LearnedEmission>();
  const std::string settings = fmt::format("{} {} {} {} {} {} {} {} {} {} {}", guided, both, may_go_on, hit_point.go_on,
                                           photon.kinds, photon.max_depth, photon.least_alpha, photon.hidden,
                                           hit_point.max_depth, hit_point.least_alpha, hit_point.radius);
  if (!render.file->learns()) return render.file->earlier(settings, scene);
  if (guided) render.file->expect_known(settings, scene.lights.size());
  const auto learned = render.file->emission(settings, [&] {
    const Activity activity("learning where photons start");
    PilotPaths pilot;
    LearnedEmission result;
    const std::shared_ptr<const Scene> sample = render.file->scene(scene);
    if (guided)
      result.guides = learn_emission(*sample, render, photon, hit_point, pilot);
    else if (render.count_found)
      count_found(*sample, render, photon, hit_point, pilot);
    std::size_t bytes = 0;
    if (both) result.direct = learn_direct(*sample, render, hit_point, photons, result.guides, bytes);
    if (may_go_on && (!both || result.direct.by_rays)) {
      result.goes_on = paths_that_go_on_pay(*sample, render, photon, hit_point, photons, result.guides);
      if (result.goes_on && guided)
        result.guides = learn_emission(*sample, render, without_diffuse(photon), going_on(hit_point), pilot);
    }
    result.bytes_while_learning = std::max(bytes, pilot.bytes);
    result.lights = static_cast<std::int32_t>(sample->lights.size());
    if (pilot.rounds > 0) result.report = report_of(pilot, *sample, photon, result.guides, guided);
    result.report.goes_on = result.goes_on;
    return result;
  });
  if (learned->report.rounds > 0) statistics.emission.put(learned->report);
  return learned;
}

}  // namespace dspm
