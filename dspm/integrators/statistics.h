// What an integrator did, in counts and seconds: the figures of the table at the end of a run.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "dspm/integrators/rejections.h"
#include "dspm/system/state_stream.h"

namespace dspm {

/// Work that several frames share: what was done, and what separate renders of the frames would have done.
struct SharedCount {
  std::uint64_t done = 0, separate = 0;

  void add(int frames) { ++done, separate += static_cast<std::uint64_t>(frames); }
  SharedCount& operator+=(const SharedCount& o) {
    done += o.done, separate += o.separate;
    return *this;
  }
  /// The sharing factor; 1 where nothing was done.
  double factor() const { return done == 0 ? 1 : static_cast<double>(separate) / static_cast<double>(done); }
};

/// Paths of one kind (camera or photon), counted over all frames.
struct PathCounts {
  SharedCount segments;             // rays traced for paths
  std::uint64_t paths = 0;          // started
  std::uint64_t dynamic_paths = 0;  // met in at least one frame what is not there in all
  std::uint64_t shadow_rays = 0;
  std::uint64_t weighted = 0;  // hit points, or photons stored, in which frames have weights of their own

  PathCounts& operator+=(const PathCounts& o) {
    segments += o.segments, paths += o.paths, dynamic_paths += o.dynamic_paths, shadow_rays += o.shadow_rays;
    weighted += o.weighted;
    return *this;
  }
  double dynamic_share() const {
    return paths == 0 ? 0 : static_cast<double>(dynamic_paths) / static_cast<double>(paths);
  }
};

/// Flux in W summed over the three channels, by frame: emitted = absorbed + escaped + terminated + roulette.
struct EnergyBalance {
  double emitted = 0, absorbed = 0, escaped = 0;
  double terminated = 0;  // cut off by the depth, or because no photon of its kind is stored
  double roulette = 0;    // of the paths that Russian roulette ends, less what it adds to the others: 0 in the mean

  EnergyBalance& operator+=(const EnergyBalance& o) {
    emitted += o.emitted, absorbed += o.absorbed, escaped += o.escaped;
    terminated += o.terminated, roulette += o.roulette;
    return *this;
  }
  EnergyBalance operator*(double s) const {
    return {emitted * s, absorbed * s, escaped * s, terminated * s, roulette * s};
  }
  friend bool operator==(const EnergyBalance&, const EnergyBalance&) = default;
};

struct StepTime {
  std::string name;  // "hit points", "photons", "photon map", "statistics", ...
  double seconds = 0;
};

struct Statistics {
  int iterations = 0;
  std::vector<StepTime> steps;
  PathCounts camera, photon;
  SharedCount photons_stored;
  SharedCount gathers;  // places where photons were gathered
  // Distance tests of the gathers. What separate renders would test cannot be told: the cells of their grids differ.
  std::uint64_t photon_tests = 0;
  SharedCount photons_found;          // that passed; separate renders with radii of their own find no more
  Rejections rejections;              // contributions that were not finite
  std::vector<EnergyBalance> energy;  // a frame each; empty where no photons are traced
  std::size_t bytes = 0;              // of the integrator's own buffers, at their largest
  int photon_batches = 1;             // an iteration

  /// What adds up from iteration to iteration.
  void persist(StateStream& state);
};

/// Adds the time of its own life to a StepTime.
class StepTimer {
 public:
  explicit StepTimer(StepTime& step) : step_(step) {}
  ~StepTimer() { step_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
  StepTimer(const StepTimer&) = delete;
  StepTimer& operator=(const StepTimer&) = delete;

 private:
  StepTime& step_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace dspm
