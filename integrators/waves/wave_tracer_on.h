// Traces waves on any machine (machine.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/integrators/waves/followed_waves.h"
#include "dspm/integrators/waves/scene_copy.h"
#include "dspm/integrators/waves/wave_steps.h"
#include "dspm/integrators/waves/wave_tracer.h"

namespace dspm {

template <class Machine>
class WaveTracerOn final : public WaveTracer {
 public:
  template <class... Args>
  explicit WaveTracerOn(Args&&... args)
      : machine_(std::forward<Args>(args)...), photons_(machine_), camera_(machine_) {}

  std::string name() const override { return machine_.name(); }
  std::size_t paths_at_once() const override { return machine_.paths_at_once(); }

  void load(const PlainScene& scene) override {
    copy_.reset();
    scene_ = scene;
    if constexpr (Machine::kOwnMemory) scene_ = copy_.emplace(scene, machine_).scene();
  }

  PhotonWaves trace(const PhotonWave& wave, const WaveStarts<PhotonState>& starts) override {
    double emitted = 0;
    for (const PhotonState& path : starts.states) emitted += sum(path.throughput);
    const FixedPoint unit(emitted);
    const PhotonSteps steps{{.all = starts.frames}, scene_, wave, unit};
    photons_.follow(steps, starts.states, starts.paths, WaveSums::of_photons(starts.frames));
    PhotonWaves left;
    const std::vector<std::int64_t> sums = finish(photons_, starts.paths, left);
    left.photons = photons_.template sorted<WavePhoton>();
    for (std::size_t at = WaveSums::kEnergy; at < sums.size(); at += WaveSums::kEntries) {
      const auto entry = [&](WaveSums::Entry which) { return unit.number(sums[at + which]); };
      left.energy.push_back({entry(WaveSums::kAbsorbed), entry(WaveSums::kEscaped), entry(WaveSums::kTerminated),
                             entry(WaveSums::kRoulette), entry(WaveSums::kTooDeep)});
    }
    return left;
  }

  CameraWaves trace(const CameraWave& wave, const WaveStarts<CameraState>& starts) override {
    const CameraSteps steps{{.all = starts.frames}, scene_, wave};
    camera_.follow(steps, starts.states, starts.paths, WaveSums::of_camera());
    CameraWaves left;
    finish(camera_, starts.paths, left);
    left.hit_points = camera_.template sorted<WaveHitPoint>();
    left.sights = camera_.template sorted<WaveSight>();
    return left;
  }

 private:
  template <class Waves>
  std::vector<std::int64_t> finish(Waves& waves, std::uint32_t paths, WaveOutcome& left) {
    std::vector<std::int64_t> sums = waves.sums();
    left.segments = {static_cast<std::uint64_t>(sums[WaveSums::kDone]),
                     static_cast<std::uint64_t>(sums[WaveSums::kSeparate])};
    left.parted = waves.parted(paths);
    left.rejections = waves.template sorted<WaveRejection>();
    return sums;
  }

  Machine machine_;
  PlainScene scene_;
  std::optional<SceneCopy<Machine>> copy_;
  FollowedWaves<Machine, PhotonState, WavePhoton, WaveRejection> photons_;
  FollowedWaves<Machine, CameraState, WaveHitPoint, WaveSight, WaveRejection> camera_;
};

}  // namespace dspm
