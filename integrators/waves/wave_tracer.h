// What traces waves: the CPU's threads or a card. Plain values go in and come out, so it knows no scene, no light, and no
// plugin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/untouched.h"
#include "dspm/integrators/photons/plain_photon_map.h"
#include "dspm/integrators/photons/point_flux.h"
#include "dspm/integrators/waves/camera_wave.h"
#include "dspm/integrators/waves/gather_wave.h"
#include "dspm/integrators/waves/photon_wave.h"
#include "dspm/integrators/waves/plain_scene.h"

namespace dspm {

/// A path that has met values that are not finite.
struct WaveRejection {
  std::uint32_t start;
  std::uint16_t bounces;
  bool is_shape;  // it gave them; else a material did
  int index;      // of the shape or material
  FrameSet frames;

  constexpr std::uint64_t order() const { return wave_order(start, bounces, frames, is_shape ? 1 : 0); }
};

/// Counts of rays.
struct WaveSegments {
  std::uint64_t done = 0, separate = 0;  // see SharedCount
};

/// Flux that paths have lost, see EnergyBalance.
struct WaveEnergy {
  double absorbed = 0, escaped = 0, terminated = 0, roulette = 0, too_deep = 0;
};

struct WaveOutcome {
  std::vector<std::uint8_t> parted;  // by path: whether it has met something that differs between frames
  WaveSegments segments;
  UntouchedVector<WaveRejection> rejections;  // in their order()
};

struct PhotonWaves : WaveOutcome {
  UntouchedVector<WavePhoton> photons;  // in their order()
  std::vector<WaveEnergy> energy;       // by frame; the last is that of flux in all frames, and counts for each
};

struct CameraWaves : WaveOutcome {
  UntouchedVector<WaveHitPoint> hit_points;  // in their order()
  UntouchedVector<WaveSight> sights;         // in their order()
};

/// Paths of a wave, in which all starts of one number are next to one another.
template <class State>
struct WaveStarts {
  std::span<const State> states;
  std::uint32_t paths;  // numbers are below this
  FrameSet frames;      // all of the scene
};

class WaveTracer {
 public:
  virtual ~WaveTracer() = default;
  /// Returns what it traces on, for people: "NVIDIA H200".
  virtual std::string name() const = 0;
  /// Sets the scene. What it points to must live, and stay as it is, until the next call, unless the machine has its own
  /// memory. Throws MachineFailure, see machine.h.
  virtual void load(const PlainScene& scene) = 0;
  /// Returns how many paths should be traced at once.
  virtual std::size_t paths_at_once() const = 0;
  /// Gives back all memory but the scene's, and makes it half as many paths from now on. Returns false if these are too few.
  virtual bool take_fewer() = 0;
  /// Follows paths to their ends. The results depend on no order. These throw MachineFailure, too.
  virtual PhotonWaves trace(const PhotonWave& wave, const WaveStarts<PhotonState>& starts) = 0;
  virtual CameraWaves trace(const CameraWave& wave, const WaveStarts<CameraState>& starts) = 0;
  /// Gathers the photons at points of the scene.
  virtual FluxOfPoints gather(const PlainPhotonMap& map, std::span<const GatherPoint> points,
                              std::span<const GatherScattering> scatterings) = 0;
};

}  // namespace dspm
