// dsppm on all frames of a scene and sppm on each of them, iteration by iteration in turn, so that other load on the
// machine slows both alike: the four steps and the total as in WG12's table 1, each next to its sharing factor.
#pragma once

#include "bench/measure/rounds.h"
#include "bench/report/wg12.h"

namespace dspm {

/// What both took.
struct InTurns {
  int frames = 0;
  StepSeconds together{}, separate{};  // medians over iterations; separate: of all frames
  StepSeconds speedups{};              // medians of the iterations' ratios
  /// The work of the separate runs over that of the joint one, in counts; see sharing_factors. For the total: the
  /// speedup if every step reached its factor.
  StepSeconds factors{};
  double dynamic_photons = 0, dynamic_hit_points = 0;  // shares of the paths
};

struct TurnSettings {
  int iterations = 6;         // the first, in which buffers grow, does not count
  std::size_t separate = 64;  // at most this many frames are rendered one by one; all others count as their mean
};

/// All of the job's frames, together and separately.
InTurns take_turns(const LoadedScene& loaded, const Job& job, const TurnSettings& settings);

/// One row per step; `paper` are WG12's speedups, if there are any.
std::string table_of(const InTurns& comparison, const wg12::Speedups* paper);
/// "1.2% of the photon paths and 11.3% of the camera paths met something that differs between frames."
std::string dynamic_shares(const InTurns& comparison);

}  // namespace dspm
