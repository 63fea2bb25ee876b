// A wave of photon paths: each thread of a device would take the step of one.
#include "words.h"

#include <cstdint>

#include "dspm/accel/ray_hit.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/waves/photon_wave.h"

namespace dspm {

/// Counts in place of lists.
struct WaveCounts {
  std::uint32_t segments, parts, stored, ended, rejected;
  PhotonState next;
  WavePhoton photon;
  Spectrum absorbed;

  constexpr void segment(const PhotonState&, const HitPartition& met) {
    ++segments, parts += static_cast<std::uint32_t>(met.size());
  }
  constexpr void store(const WavePhoton& p) { ++stored, photon = p; }
  constexpr void push(const PhotonState& path) { next = path; }
  constexpr void end(const PhotonState&, FrameSet, PhotonEnd) { ++ended; }
  constexpr void scatter(FrameSet, const Spectrum& before, const Spectrum& after, const Spectrum&) {
    absorbed += before - after;
  }
  constexpr void reject_shape(int, FrameSet) { ++rejected; }
  constexpr void reject_material(int, FrameSet) { ++rejected; }
};

}  // namespace dspm

extern "C" __global__ void waves(const dspm::PlainScene* scene, const dspm::PhotonWave* wave, const dspm::PhotonState* paths,
                                 dspm::WaveCounts* counts) {
  dspm::step(*scene, scene->query, *wave, *paths, *counts);
}
