// The steps of all paths of a wave, each by a call of its own: what they leave goes to lists and sums that they share.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/waves/camera_wave.h"
#include "dspm/integrators/waves/fixed_point.h"
#include "dspm/integrators/waves/machine.h"
#include "dspm/integrators/waves/photon_wave.h"
#include "dspm/integrators/waves/shared_sums.h"
#include "dspm/integrators/waves/wave_tracer.h"

namespace dspm {

/// The sums that some steps share, each a number of an array.
struct WaveSums {
  enum Place : std::size_t { kDone, kSeparate, kEnergy };
  enum Entry : std::size_t { kAbsorbed, kEscaped, kTerminated, kRoulette, kTooDeep, kEntries };

  std::int64_t* sums;

  static constexpr std::size_t of_camera() { return kEnergy; }
  static constexpr std::size_t of_photons(FrameSet frames) {
    return kEnergy + (static_cast<std::size_t>(frames.count()) + 1) * kEntries;
  }

  constexpr void add(std::size_t place, std::int64_t value) const { add_among_sharers(sums[place], value); }
  constexpr void add_segment(FrameSet frames) const { add(kDone, 1), add(kSeparate, frames.count()); }
  constexpr void add_energy(std::size_t frame, Entry entry, std::int64_t value) const {
    add(kEnergy + frame * kEntries + entry, value);
  }
};

/// What both kinds of steps leave.
template <class State>
struct WaveStepOut {
  FrameSet all = {};  // frames of the scene
  WaveList<State> next = {};
  WaveList<WaveRejection> rejections = {};
  std::uint8_t* parted = nullptr;  // by path
  std::int64_t* sums = nullptr;    // WaveSums for each group of kSharers
  const State* paths = nullptr;    // of the wave
};

/// What a step of either kind reports, see photon_wave.h and camera_wave.h.
template <class Steps, class State>
struct WaveReports {
  const Steps& to;
  WaveSums sums;

  constexpr void segment(const State& path, const HitPartition& parts) const {
    sums.add_segment(path.frames);
    if (parts.size() > 1 || path.frames != to.all) part(path);
  }
  constexpr void push(const State& path) const { to.next.append(path); }
  constexpr void part(const State& path) const { to.parted[path.path] = 1; }
  constexpr void reject_shape(const State& path, int shape) const { reject(path, true, shape); }
  constexpr void reject_material(const State& path, int material) const { reject(path, false, material); }

 private:
  constexpr void reject(const State& path, bool is_shape, int index) const {
    to.rejections.append({path.start, path.bounces, is_shape, index, path.frames});
  }
};

struct PhotonSteps : WaveStepOut<PhotonState> {
  PlainScene scene;
  PhotonWave wave;
  FixedPoint unit;  // of energy
  WaveList<WavePhoton> photons = {};

  void append_to(const WaveList<WavePhoton>& to_photons, const WaveList<WaveRejection>& to_rejections) {
    photons = to_photons, rejections = to_rejections;
  }
  constexpr void operator()(std::size_t i) const {
    Out out{{*this, {sums + i / kSharers * WaveSums::of_photons(all)}}};
    step(scene, PlainSceneQuery{scene}, wave, paths[i], out);
  }

 private:
  struct Out : WaveReports<PhotonSteps, PhotonState> {
    constexpr void store(const WavePhoton& photon) const { to.photons.append(photon); }
    constexpr void end(const PhotonState& path, PhotonEnd end) const {
      const FrameSet frames = path.frames;
      const std::int64_t flux = to.unit.of(sum(path.throughput));
      if (end == PhotonEnd::too_deep) add(frames, WaveSums::kTooDeep, flux);
      add(frames,
          end == PhotonEnd::escaped    ? WaveSums::kEscaped
          : end == PhotonEnd::absorbed ? WaveSums::kAbsorbed
                                       : WaveSums::kTerminated,
          flux);
    }
    constexpr void dim(FrameSet frames, const Spectrum& before, const Spectrum& after) const {
      add(frames, WaveSums::kAbsorbed, to.unit.of(sum(before) - sum(after)));
    }
    constexpr void scatter(FrameSet frames, const Spectrum& before, const Spectrum& after,
                           const Spectrum& surviving) const {
      add(frames, WaveSums::kAbsorbed, to.unit.of(sum(before) - sum(after)));
      add(frames, WaveSums::kRoulette, to.unit.of(sum(after) - sum(surviving)));
    }

    constexpr void add(FrameSet frames, WaveSums::Entry entry, std::int64_t flux) const {
      if (frames == to.all) return sums.add_energy(static_cast<std::size_t>(to.all.count()), entry, flux);
      frames.for_each([&](Frame f) { sums.add_energy(static_cast<std::size_t>(f), entry, flux); });
    }
  };
};

struct CameraSteps : WaveStepOut<CameraState> {
  PlainScene scene;
  CameraWave wave;
  WaveList<WaveHitPoint> hit_points = {};
  WaveList<WaveSight> sights = {};

  void append_to(const WaveList<WaveHitPoint>& to_hit_points, const WaveList<WaveSight>& to_sights,
                 const WaveList<WaveRejection>& to_rejections) {
    hit_points = to_hit_points, sights = to_sights, rejections = to_rejections;
  }
  constexpr void operator()(std::size_t i) const {
    Out out{{*this, {sums + i / kSharers * WaveSums::of_camera()}}};
    step(scene, PlainSceneQuery{scene}, wave, paths[i], out);
  }

 private:
  struct Out : WaveReports<CameraSteps, CameraState> {
    constexpr void see(const WaveSight& sight) const { to.sights.append(sight); }
    constexpr void store(const WaveHitPoint& hit) const { to.hit_points.append(hit); }
  };
};

}  // namespace dspm
