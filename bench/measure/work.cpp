#include "bench/measure/work.h"

#include <algorithm>

namespace dspm {

StepWork work_of(const Integrator& integrator) {
  const Statistics s = integrator.statistics();
  const auto number = [](std::uint64_t count) { return static_cast<double>(count); };
  return {{{number(s.camera.segments.done)},
           {number(s.photon.segments.done)},
           {number(s.photons_stored.done)},
           {number(s.gathers.done), number(s.photon_tests), number(s.photons_found.done)}}};
}

StepWork mean_work(const Group& runs) {
  StepWork mean = work_of(*runs.front().integrator);
  for (std::size_t run = 1; run < runs.size(); ++run) {
    const StepWork more = work_of(*runs[run].integrator);
    for (std::size_t s = 0; s < mean.size(); ++s)
      for (std::size_t kind = 0; kind < mean[s].size(); ++kind) mean[s][kind] += more[s][kind];
  }
  for (std::vector<double>& kinds : mean)
    for (double& count : kinds) count /= static_cast<double>(runs.size());
  return mean;
}

StepSeconds sharing_factors(const StepWork& separate, double count, const StepWork& together) {
  StepSeconds factors{};
  for (std::size_t s = 0; s < separate.size(); ++s)
    for (std::size_t kind = 0; kind < separate[s].size(); ++kind)
      if (together[s][kind] > 0) factors[s] = std::max(factors[s], count * separate[s][kind] / together[s][kind]);
  return factors;
}

}  // namespace dspm
