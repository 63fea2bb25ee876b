// Sums where the flux of photons goes, frame by frame: what lights emit is absorbed, escapes, or ends with its path.
#pragma once

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/counters.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/integrators/transport/strand.h"

namespace dspm {

/// The energy of the paths of one trace, whose lists of strands are those of the lights at that time.
class PhotonEnergy {
 public:
  PhotonEnergy(int frames, PhotonTrace& trace) : frames_(FrameSet::first(frames)), trace_(trace) {
    trace.energy.assign(static_cast<std::size_t>(frames) + trace.own_strands, {});
  }

  /// Adds a path's flux in these frames to `entry`.
  void add(StrandList strands, const Spectrum& flux, FrameSet frames, double EnergyBalance::*entry) {
    change(strands, frames, [&](EnergyBalance& e, const Spectrum& weight) { e.*entry += sum(flux * weight); });
  }
  /// Calls fn(balance, weight) for these frames. If all frames share a grey list of a light, the list has its own
  /// balance, which is distributed to the frames in the end.
  template <class Fn>
  void change(StrandList weights, FrameSet frames, Fn&& fn) {
    const Strand* list = trace_.strands.of(weights);
    if (frames == frames_ && weights < trace_.own_strands && (list == nullptr || list->grey))
      return fn(of_list(weights), Spectrum(1));
    for_each_strand(list, frames, [&](FrameSet alike, const Spectrum& weight) {
      alike.for_each([&](Frame f) { fn(trace_.energy[static_cast<std::size_t>(f)], weight); });
    });
  }

  void finish() {
    for (StrandList list = 0; list < trace_.own_strands; ++list) {
      const EnergyBalance shared = of_list(list);
      if (shared == EnergyBalance{}) continue;
      for_each_strand(trace_.strands.of(list), frames_, [&](FrameSet alike, const Spectrum& grey) {
        alike.for_each(
            [&](Frame f) { trace_.energy[static_cast<std::size_t>(f)] += shared * static_cast<double>(grey[0]); });
      });
    }
    trace_.energy.resize(static_cast<std::size_t>(frames_.count()));
  }

 private:
  EnergyBalance& of_list(StrandList list) { return trace_.energy[static_cast<std::size_t>(frames_.count()) + list]; }

  FrameSet frames_;
  PhotonTrace& trace_;
};

}  // namespace dspm
