// A wave of camera paths, as waves.cu has one of photon paths.
#include "words.h"

#include <cstdint>

#include "dspm/accel/ray_hit.h"
#include "dspm/integrators/waves/camera_wave.h"

namespace dspm {

/// Counts in place of lists.
struct CameraWaveCounts {
  std::uint32_t segments, parts, sights, stored, rejected;
  CameraState next;
  WaveSight sight;
  WaveHitPoint hit;

  constexpr void segment(const CameraState&, const HitPartition& met) {
    ++segments, parts += static_cast<std::uint32_t>(met.size());
  }
  constexpr void see(const WaveSight& s) { ++sights, sight = s; }
  constexpr void store(const WaveHitPoint& h) { ++stored, hit = h; }
  constexpr void push(const CameraState& path) { next = path; }
  constexpr void reject_shape(const CameraState&, int) { ++rejected; }
  constexpr void reject_material(const CameraState&, int) { ++rejected; }
};

}  // namespace dspm

extern "C" __global__ void camera_waves(const dspm::PlainScene* scene, const dspm::CameraWave* wave,
                                        const dspm::CameraState* paths, dspm::CameraWaveCounts* counts) {
  dspm::step(*scene, scene->query, *wave, *paths, *counts);
}
