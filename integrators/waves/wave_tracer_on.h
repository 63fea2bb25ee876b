// Traces waves on any machine (machine.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/integrators/waves/followed_waves.h"
#include "dspm/integrators/waves/gather_wave.h"
#include "dspm/integrators/waves/plain_copy.h"
#include "dspm/integrators/waves/wave_lists.h"
#include "dspm/integrators/waves/wave_steps.h"
#include "dspm/integrators/waves/wave_tracer.h"

namespace dspm {

template <class Machine>
class WaveTracerOn final : public WaveTracer {
 public:
  template <class... Args>
  explicit WaveTracerOn(Args&&... args)
      : machine_(std::forward<Args>(args)...),
        photons_(machine_),
        camera_(machine_),
        points_(machine_),
        scatterings_(machine_),
        flux_(machine_),
        gathered_(machine_) {}

  std::string name() const override { return machine_.name(); }
  std::size_t paths_at_once() const override { return machine_.paths_at_once() >> halvings_; }

  bool take_fewer() override {
    constexpr std::size_t kFewest = 1 << 12;
    photons_.release(), camera_.release();
    points_.release(), scatterings_.release(), flux_.release(), gathered_.release();
    if (paths_at_once() <= kFewest) return false;
    ++halvings_;
    return true;
  }

  void load(const PlainScene& scene) override {
    copy_.reset();
    scene_ = scene;
    if constexpr (Machine::kOwnMemory) scene_ = copy_.emplace(scene, machine_).value();
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

  FluxOfPoints gather(const PlainPhotonMap& map, std::span<const GatherPoint> points,
                      std::span<const GatherScattering> scatterings) override {
    points_.copy_in(points), scatterings_.copy_in(scatterings), flux_.reserve(points.size());
    GatherSteps steps{scene_, map, points_.data(), scatterings_.data(), flux_.data()};
    std::optional<PlainCopy<PlainPhotonMap, Machine>> copy;
    if constexpr (Machine::kOwnMemory) steps.map = copy.emplace(map, machine_).value();
    gathered_.clear();
    gathered_.append(
        points.size(),
        [&](const auto&... lists) {
          steps.append_to(lists...);
          machine_.for_each(points.size(), steps);
        },
        [] {});
    FluxOfPoints flux;
    flux.points.resize(points.size());
    flux_.copy_out(flux.points);
    flux.own = gathered_.template items<Spectrum>();
    flux.rejections = gathered_.template sorted<FluxOfPoints::Rejection>();
    return flux;
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
  unsigned halvings_ = 0;  // of the paths that are traced at once
  PlainScene scene_;
  std::optional<PlainCopy<PlainScene, Machine>> copy_;
  FollowedWaves<Machine, PhotonState, WavePhoton, WaveRejection> photons_;
  FollowedWaves<Machine, CameraState, WaveHitPoint, WaveSight, WaveRejection> camera_;
  MachineArray<GatherPoint, Machine> points_;
  MachineArray<GatherScattering, Machine> scatterings_;
  MachineArray<PointFlux, Machine> flux_;
  WaveLists<Machine, Spectrum, FluxOfPoints::Rejection> gathered_;
};

}  // namespace dspm
