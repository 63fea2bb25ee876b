// An integrator at work, for the programs here that compare integrators.
#pragma once

#include <memory>
#include <vector>

#include "app/load.h"

namespace dspm {

struct Run {
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Integrator> integrator;
};

/// The scene's own integrator with other settings, or another one.
inline Run start(const LoadedScene& loaded, Job job, const char* integrator, const std::vector<Frame>& frames) {
  for (const auto& plugin : integrator_plugins())
    if (plugin.name == integrator) job.plugin = &plugin, job.integrator = integrator;
  Diagnostics diagnostics;
  Run run{loaded.world->scene(frames), nullptr};
  run.integrator = job.make_integrator(*run.scene, diagnostics);
  diagnostics.throw_if_errors();
  return run;
}

inline Job with_text(Job job, const char* name, const char* value) {
  std::erase_if(job.params.params, [&](const Param& p) { return p.name == name; });
  Param param;
  param.type = ParamType::text, param.name = name, param.values = std::vector<std::string>{value};
  job.params.params.push_back(param);
  return job;
}

/// Seconds of all steps so far.
inline double seconds(const Statistics& s) {
  double sum = 0;
  for (const auto& step : s.steps) sum += step.seconds;
  return sum;
}

}  // namespace dspm
