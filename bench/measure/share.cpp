#include "bench/measure/share.h"

#include "bench/measure/work.h"
#include "bench/report/table.h"
#include "dspm/base/math/moments.h"

namespace dspm {

Share measure_share(const LoadedScene& loaded, const std::vector<FileFrame>& frames, std::size_t alone,
                    int iterations) {
  std::vector<Group> groups(3);
  groups[0].push_back(start(loaded, loaded.job, "dsppm", frames));
  groups[1] = start_each(loaded, loaded.job, "dsppm", spread_frames(frames, alone));
  groups[2] = start_each(loaded, loaded.job, "sppm", spread_frames(frames, alone));
  const std::vector<Rounds> rounds = in_turns(groups, iterations);
  const Statistics s = groups[0][0].integrator->statistics();
  StepSeconds counted = sharing_factors(mean_work(groups[2]), 1, work_of(*groups[0][0].integrator));
  for (double& factor : counted) factor = factor > 0 ? 1 / factor : 0;
  return {.frames = static_cast<int>(frames.size()),
          .together = medians(rounds[0]),
          .dsppm = medians(rounds[1]),
          .sppm = medians(rounds[2]),
          .over_dsppm = ratios(rounds[0], rounds[1]),
          .over_sppm = ratios(rounds[0], rounds[2]),
          .counted = counted,
          .dynamic_photons = s.photon.dynamic_share(),
          .dynamic_hit_points = s.camera.dynamic_share()};
}

std::string table_of(const Share& share) {
  Table table({"step", fmt::format("{} together, s", share.frames), "of all", "one, dsppm, s", "ratio", "one, sppm, s",
               "ratio", "counted"});
  for (std::size_t s = 0; s < kStepNames.size(); ++s)
    table.row({kStepNames[s], seconds_cell(share.together[s]),
               fmt::format("{:.0f}%", 100 * share.together[s] / share.together.back()), seconds_cell(share.dsppm[s]),
               ratio_cell(share.over_dsppm[s]), seconds_cell(share.sppm[s]), ratio_cell(share.over_sppm[s]),
               ratio_cell(share.counted[s])});
  return table.text();
}

}  // namespace dspm
