#include "dspm/session/explain_photons.h"

#include <memory>
#include <utility>

#include "dspm/integrators/emission_report.h"
#include "dspm/session/session.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

std::vector<std::string> explain_photons(const LoadedScene& loaded, const FrameList& frames, Messages& messages) {
  Job job = loaded.job;
  job.settings.learn_at_once = true;
  const std::unique_ptr<Scene> scene = loaded.world->scene(frames);
  std::vector<std::string> lines;
  for (const EmissionReport& report : make_integrator(job, *scene, messages)->statistics().emission)
    for (std::string& line : in_words(report)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace dspm
