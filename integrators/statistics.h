// An integrator's work, in counts and seconds: the figures of the table at the end of a run.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "dspm/base/system/state_stream.h"
#include "dspm/base/system/work.h"
#include "dspm/integrators/counters.h"
#include "dspm/integrators/emission_report.h"
#include "dspm/integrators/rejections.h"

namespace dspm {

/// Work shared by several frames: the work done, and the work that separate renders of the frames would have done.
struct SharedCount {
  std::uint64_t done = 0, separate = 0;

  void add(int frames) { ++done, separate += static_cast<std::uint64_t>(frames); }
  SharedCount& operator+=(const SharedCount& o) {
    done += o.done, separate += o.separate;
    return *this;
  }
  /// The sharing factor; 1 if nothing was done.
  double factor() const { return done == 0 ? 1 : static_cast<double>(separate) / static_cast<double>(done); }
};

/// Paths of one kind (camera or photon), counted over all frames.
struct PathCounts {
  SharedCount segments;             // rays traced for paths
  std::uint64_t paths = 0;          // started
  std::uint64_t dynamic_paths = 0;  // met, in at least one frame, an object that is not in all of them
  std::uint64_t shadow_rays = 0;
  std::uint64_t weighted = 0;  // hit points, or photons stored, whose frames have individual weights

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
  double terminated = 0;  // cut off by the maximum depth, or because photons of this kind are not stored or wanted
  double roulette = 0;    // lost by paths that Russian roulette ends, less the gain of the survivors: 0 on average
  double too_deep = 0;    // the part of `terminated` that the maximum depth cut off

  EnergyBalance& operator+=(const EnergyBalance& o) {
    emitted += o.emitted, absorbed += o.absorbed, escaped += o.escaped;
    terminated += o.terminated, roulette += o.roulette, too_deep += o.too_deep;
    return *this;
  }
  EnergyBalance operator*(double s) const {
    return {emitted * s, absorbed * s, escaped * s, terminated * s, roulette * s, too_deep * s};
  }
  friend bool operator==(const EnergyBalance&, const EnergyBalance&) = default;
};

/// Sums of luminance that a sample of camera paths finds in one region of the picture (cut_light.h), within the maximum
/// depth and beyond it. Each sum is kept for two halves of the sample, so that chance is not taken for a loss.
struct CutLight {
  std::array<float, 2> arrived{}, cut{};

  CutLight& operator+=(const CutLight& o) {
    for (std::size_t half = 0; half < 2; ++half) arrived[half] += o.arrived[half], cut[half] += o.cut[half];
    return *this;
  }
};

/// Medians over the tiles of pixels in which photons were found.
struct TypicalHitPoint {
  double photons = 0;           // found so far
  double radius_in_pixels = 0;  // of the last search, in pixel spacings; 0: none

  /// Adds the photons and keeps the smaller radius: radii shrink, so it is the one of the last search.
  TypicalHitPoint& operator+=(const TypicalHitPoint& o) {
    photons += o.photons;
    if (radius_in_pixels == 0 || (o.radius_in_pixels > 0 && o.radius_in_pixels < radius_in_pixels))
      radius_in_pixels = o.radius_in_pixels;
    return *this;
  }
};

struct StepTime {
  std::string name;  // "hit points", "photons", "photon map", "statistics", ...
  double seconds = 0;
  Work work = {};  // of this run, if it is counted
};

struct Statistics {
  int iterations = 0;
  std::vector<StepTime> steps;
  PathCounts camera, photon;
  SharedCount photons_stored;
  SharedCount gathers;  // points at which photons were gathered
  // Distance tests of the gathers. The number for separate renders is unknown: the cells of their grids differ.
  std::uint64_t photon_tests = 0;
  SharedCount photons_found;          // tests passed; separate renders with their own radii find no more
  Rejections rejections;              // contributions that were not finite
  std::vector<EnergyBalance> energy;  // by frame; empty if no photons are traced
  std::vector<CutLight> cut_light;    // by region of the picture, and frame; empty: not counted
  TypicalHitPoint typical;            // of progressive integrators
  // By frame: the estimated error, see error_estimate.h. Empty: it is too early.
  std::vector<double> errors;
  std::size_t bytes = 0;     // peak size of the integrator's own buffers
  int photon_batches = 1;    // per iteration
  Counters counters;         // of a plugin's own
  EmissionReports emission;  // where photon paths start; empty if nothing was learned or counted
  std::string why_off_gpu;   // paths have left it for the CPU in the middle of a run; empty: they have not

  /// Saves or loads the members that accumulate over iterations.
  void persist(StateStream& state);
};

/// Adds its lifetime to a StepTime.
class StepTimer {
 public:
  explicit StepTimer(StepTime& step) : step_(step) {}
  ~StepTimer() {
    step_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    step_.work += work_done() - before_;
  }
  StepTimer(const StepTimer&) = delete;
  StepTimer& operator=(const StepTimer&) = delete;

 private:
  StepTime& step_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Work before_ = work_done();
};

}  // namespace dspm
