// Frames rendered together against one frame alone: the time of each step, and its work in counts.
#pragma once

#include <string>

#include "bench/measure/rounds.h"
#include "dspm/base/math/moments.h"

namespace dspm {

/// Of frames that share: all together, and the mean of some of them alone.
struct Share {
  int frames = 0;
  StepSeconds together{}, dsppm{}, sppm{};  // medians of seconds; of one frame by either integrator
  StepSeconds over_dsppm{}, over_sppm{};    // medians of ratios
  /// The work of all over that of the mean frame alone by sppm, in counts: of several kinds the one that grows least; 0
  /// for the total.
  StepSeconds counted{};
  double dynamic_photons = 0, dynamic_hit_points = 0;  // shares of the paths
};

/// `alone`: how many of the frames, evenly spread, are rendered one by one.
Share measure_share(const LoadedScene& loaded, const std::vector<FileFrame>& frames, std::size_t alone, int iterations);

/// One row per step.
std::string table_of(const Share& share);

}  // namespace dspm
