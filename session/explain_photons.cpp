#include "dspm/session/explain_photons.h"

#include <fmt/format.h>

#include <utility>

#include "dspm/integrators/emission_report.h"
#include "dspm/integrators/waves/plain_objects.h"
#include "dspm/session/stage.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

std::string explain_device(const Scene& scene) {
  const std::vector<std::string> reasons = reasons_not_plain(scene);
  if (reasons.empty()) return "device: photons of this scene suit a GPU (--device auto).";
  return fmt::format("device: photons of this scene do not suit a GPU: {}.", fmt::join(reasons, "; "));
}

}  // namespace

std::vector<std::string> explain_photons(const LoadedScene& loaded, const FrameList& frames, Messages& messages) {
  Job job = loaded.job;
  job.settings.learn_at_once = true;
  Stage stage(job, *loaded.world, frames);
  std::vector<std::string> lines;
  for (const EmissionReport& report : stage.make_integrator(messages).statistics().emission)
    for (std::string& line : in_words(report)) lines.push_back(std::move(line));
  if (job.plugin->traces_waves) lines.push_back(explain_device(stage.scene()));
  return lines;
}

}  // namespace dspm
