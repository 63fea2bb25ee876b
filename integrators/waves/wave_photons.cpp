#include "dspm/integrators/waves/wave_photons.h"

#include <algorithm>
#include <tuple>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/photons/photon_energy.h"
#include "dspm/integrators/photons/start_photons.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/integrators/waves/follow_waves.h"
#include "dspm/integrators/waves/photon_wave.h"
#include "dspm/integrators/waves/plain_objects.h"

namespace dspm {
namespace {

/// The waves of one range of paths, and what they leave.
class WavesOfTrace {
 public:
  WavesOfTrace(const Scene& scene, const PhotonSettings& settings, const PhotonStarts& starts, PhotonTrace& trace)
      : scene_(scene),
        settings_(settings),
        starts_(starts),
        trace_(trace),
        energy_(scene.frame_count(), trace),
        wave_{settings.max_depth, settings.least_alpha, settings.kinds} {}

  void start(std::uint64_t path, std::uint64_t iteration) {
    start_photons(scene_, settings_, starts_, numbers_of(settings_, path, iteration), {}, of_path_);
    for (const StartedPhoton& started : of_path_) {
      if (started.is_valid)
        start(started);
      else
        trace_.rejections.add({SceneElement::Kind::light, started.from.index}, started.path.frames);
    }
    ++trace_.paths.paths;
  }

  void trace(const PlainScene& plain, std::uint64_t shuffle) {
    follow_waves(next_, shuffle, [&](const PhotonState& path) { step(plain, plain.query, wave_, path, *this); });
    std::ranges::sort(photons_, {}, [&](const WavePhoton& p) {
      return std::tuple(started_[p.start].path, p.bounces, p.frames.lowest());
    });
    for (const WavePhoton& photon : photons_) keep(photon);
    trace_.paths.dynamic_paths += static_cast<std::uint64_t>(std::ranges::count(parted_, true));
    energy_.finish();
  }

  // What a step leaves, see step().
  void segment(const PhotonState& path, const HitPartition& parts) {
    trace_.paths.segments.add(path.frames.count());
    if (parts.size() > 1 || path.frames != scene_.frames()) parted_[started_[path.start].path] = true;
  }
  void store(const WavePhoton& photon) { photons_.push_back(photon); }
  void push(const PhotonState& path) { next_.push_back(path); }
  void end(const PhotonState& path, FrameSet frames, PhotonEnd end) {
    if (end == PhotonEnd::too_deep) energy_.add(0, path.throughput, frames, &EnergyBalance::too_deep);
    energy_.add(0, path.throughput, frames,
                end == PhotonEnd::escaped    ? &EnergyBalance::escaped
                : end == PhotonEnd::absorbed ? &EnergyBalance::absorbed
                                             : &EnergyBalance::terminated);
  }
  void scatter(FrameSet frames, const Spectrum& before, const Spectrum& after, const Spectrum& surviving) {
    energy_.change(0, frames, [&](EnergyBalance& e, const Spectrum&) {
      e.absorbed += sum(before) - sum(after), e.roulette += sum(after) - sum(surviving);
    });
  }
  void reject_shape(int shape, FrameSet frames) { trace_.rejections.add({SceneElement::Kind::shape, shape}, frames); }
  void reject_material(int material, FrameSet frames) {
    trace_.rejections.add({SceneElement::Kind::material, material}, frames);
  }

 private:
  /// Where a path has started; `path` counts from 0 within the trace.
  struct Started {
    PhotonOrigin from;
    std::size_t path;
  };

  void start(const StartedPhoton& started) {
    const PhotonPath& path = started.path;
    const bool of_medium = started.from.light.glow.medium != kNoMedium;
    const bool told = settings_.rays_tell && is_told_by_a_ray(scene_, started.from.light);
    next_.push_back({.ray = path.ray,
                     .throughput = path.throughput,
                     .frames = path.frames,
                     .random = path.random,
                     .must_reach = started.from.must_reach,
                     .start = static_cast<std::uint32_t>(started_.size()),
                     .bounces = 0,
                     .kind = kDirectPhotons,
                     .hidden = path.hidden,
                     .caustics = path.caustics,
                     .wants_direct = (settings_.kinds & (of_medium ? kCausticPhotons : kDirectPhotons)) != 0 && !told});
    started_.push_back({started.from, trace_.paths.paths});
    parted_.resize(trace_.paths.paths + 1);
    energy_.add(0, path.throughput, path.frames, &EnergyBalance::emitted);
  }

  void keep(const WavePhoton& photon) {
    const PhotonOrigin& from = started_[photon.start].from;
    Spectrum flux = photon.flux;
    if (photon.kind == kDirectPhotons && settings_.direct != nullptr)
      flux *= settings_.direct->weight_of_photon(from.light, from.state, from.start, {photon.p, photon.ng});
    (photon.hidden ? trace_.hidden : trace_.photons)
        .push_back({photon.p, photon.face, photon.wi, flux, photon.frames, 0, from.index, 0});
    trace_.stored.add(photon.frames.count());
  }

  const Scene& scene_;
  const PhotonSettings& settings_;
  const PhotonStarts& starts_;
  PhotonTrace& trace_;
  PhotonEnergy energy_;
  PhotonWave wave_;
  std::vector<StartedPhoton> of_path_;
  std::vector<Started> started_;
  std::vector<bool> parted_;  // by path: it has met something that differs between frames
  std::vector<PhotonState> next_;
  std::vector<WavePhoton> photons_;
};

bool has_strands(const Scene& scene, const PhotonSettings& settings, const PhotonStarts& starts) {
  if (starts.strands().end() > 1) return true;
  for (std::size_t choice = 0; choice < scene.light_choices.size(); ++choice)
    for (std::size_t light = 0; light < scene.lights.size(); ++light)
      for (const PhotonStart& start : starts.of(choice, static_cast<int>(light)))
        if (start.varied != nullptr && !(start.frames & settings.frames).empty()) return true;
  return false;
}

}  // namespace

std::string why_not_in_waves(const Scene& scene, const PhotonSettings& settings) {
  if (settings.keep_ends || settings.keep_seen || settings.own_wavelengths) return "its photons are those of a pilot";
  if (has_strands(scene, settings, PhotonStarts(scene, settings.share_paths)))
    return "lights differ between frames in strength or colour";
  return why_not_plain(scene);
}

std::vector<PhotonTrace> trace_photons_in_waves(const Scene& scene, const PlainScene& plain,
                                                const PhotonSettings& settings, std::uint64_t iteration,
                                                std::int64_t first, std::int64_t end, std::vector<PhotonTrace> reuse,
                                                std::uint64_t shuffle) {
  const PhotonStarts starts(scene, settings.share_paths);
  reuse.resize(static_cast<std::size_t>(chunk_count(end - first, settings.paths_per_trace)));
  parallel_chunks(end - first, settings.paths_per_trace, [&](std::int64_t chunk, std::int64_t chunk_end) {
    PhotonTrace& trace = reuse[static_cast<std::size_t>(chunk / settings.paths_per_trace)];
    clear(trace, starts.strands());
    WavesOfTrace waves(scene, settings, starts, trace);
    for (std::int64_t i = first + chunk; i < first + chunk_end; ++i)
      waves.start(static_cast<std::uint64_t>(i), iteration);
    waves.trace(plain, shuffle);
  });
  return reuse;
}

}  // namespace dspm
