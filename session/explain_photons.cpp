#include "dspm/session/explain_photons.h"

#include <utility>

#include "dspm/integrators/emission_report.h"
#include "dspm/session/stage.h"

namespace dspm {

std::vector<std::string> explain_photons(const LoadedScene& loaded, const FrameList& frames, Messages& messages) {
  Job job = loaded.job;
  job.settings.learn_at_once = true;
  Stage stage(job, *loaded.world, frames);
  std::vector<std::string> lines;
  for (const EmissionReport& report : stage.make_integrator(messages).statistics().emission)
    for (std::string& line : in_words(report)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace dspm
