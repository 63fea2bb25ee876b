#include "dspm/integrators/waves/wave_photons.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/photons/photon_energy.h"
#include "dspm/integrators/photons/start_photons.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/integrators/waves/parts_of_waves.h"
#include "dspm/integrators/waves/plain_objects.h"

namespace dspm {
namespace {

/// What starts in one trace, and what waves leave there.
class TraceOfWaves {
 public:
  TraceOfWaves(const Scene& scene, const PhotonSettings& settings, const PhotonStarts& starts, PhotonTrace& trace)
      : scene_(scene), settings_(settings), starts_(starts), trace_(trace) {
    clear(trace, starts.strands());
  }

  void start(std::int64_t first, std::int64_t end, std::uint64_t iteration) {
    PhotonEnergy energy(scene_.frame_count(), trace_);
    for (std::int64_t path = first; path < end; ++path) {
      const PathRandom random = numbers_of(settings_, static_cast<std::uint64_t>(path), iteration);
      start_photons(scene_, settings_, starts_, random, {}, of_path_);
      for (const StartedPhoton& started : of_path_) {
        if (started.is_valid) {
          start(started);
          energy.add(0, started.path.throughput, started.path.frames, &EnergyBalance::emitted);
        } else {
          trace_.rejections.add({SceneElement::Kind::light, started.from.index}, started.path.frames);
        }
      }
      ++trace_.paths.paths;
    }
    energy.finish();
  }

  const std::vector<PhotonState>& states() const { return states_; }
  std::uint32_t paths() const { return static_cast<std::uint32_t>(trace_.paths.paths); }

  void keep(const PhotonWaves& waves, const PartRange& range) {
    for (const WavePhoton& photon : range.of(waves.photons)) keep(photon, from_[range.start(photon)]);
    for (const WaveRejection& rejection : range.of(waves.rejections))
      trace_.rejections.add(element_of(rejection), rejection.frames);
    trace_.paths.dynamic_paths += range.parted(waves);
  }

 private:
  void start(const StartedPhoton& started) {
    const PhotonPath& path = started.path;
    const bool of_medium = started.from.light.glow.medium != kNoMedium;
    const bool told = settings_.rays_tell && is_told_by_a_ray(scene_, started.from.light);
    states_.push_back({.ray = path.ray,
                       .throughput = path.throughput,
                       .frames = path.frames,
                       .random = path.random,
                       .must_reach = started.from.must_reach,
                       .start = static_cast<std::uint32_t>(states_.size()),
                       .path = paths(),
                       .bounces = 0,
                       .kind = kDirectPhotons,
                       .hidden = path.hidden,
                       .caustics = path.caustics,
                       .alone = false,
                       .wants_direct = (settings_.kinds & (of_medium ? kCausticPhotons : kDirectPhotons)) != 0 && !told,
                       .bodies = {path.inside, 0}});
    from_.push_back(started.from);
  }

  void keep(const WavePhoton& photon, const PhotonOrigin& from) {
    Spectrum flux = photon.flux;
    if (photon.kind == kDirectPhotons && settings_.direct != nullptr)
      flux *= settings_.direct->weight_of_photon(from.light, from.state, from.start, {photon.p, photon.ng});
    (photon.hidden ? trace_.hidden : trace_.photons)
        .push_back({photon.p, photon.face, photon.wi, flux, photon.frames, 0, from.index,
                    photon.alone ? trace_.only_nm : std::int16_t{0}});
    trace_.stored.add(photon.frames.count());
  }

  const Scene& scene_;
  const PhotonSettings& settings_;
  const PhotonStarts& starts_;
  PhotonTrace& trace_;
  std::vector<StartedPhoton> of_path_;
  std::vector<PhotonState> states_;
  std::vector<PhotonOrigin> from_;  // by start
};

/// Adds what is counted for all traces at once to one of them.
void add_counts(const PhotonWaves& waves, PhotonTrace& trace) {
  trace.paths.segments += {waves.segments.done, waves.segments.separate};
  for (std::size_t f = 0; f < trace.energy.size(); ++f)
    for (const WaveEnergy& lost : {waves.energy[f], waves.energy.back()})
      trace.energy[f] += {.absorbed = lost.absorbed,
                          .escaped = lost.escaped,
                          .terminated = lost.terminated,
                          .roulette = lost.roulette,
                          .too_deep = lost.too_deep};
}

bool has_strands(const Scene& scene, const PhotonSettings& settings, const PhotonStarts& starts) {
  if (starts.strands().end() > 1) return true;
  for (std::size_t choice = 0; choice < scene.light_choices.size(); ++choice)
    for (std::size_t light = 0; light < scene.lights.size(); ++light)
      for (const PhotonStart& start : starts.of(choice, static_cast<int>(light)))
        if (start.varied != nullptr && !(start.frames & settings.frames).empty()) return true;
  return false;
}

}  // namespace

std::string why_not_by_settings(const Scene& scene, const PhotonSettings& settings) {
  if (settings.keep_ends || settings.keep_seen || settings.own_wavelengths) return "its photons are those of a pilot";
  if (has_strands(scene, settings, PhotonStarts(scene, settings.share_paths)))
    return "lights differ between frames in strength or colour, and frames share paths (\"bool sharepaths\" false "
           "parts them)";
  if (settings.share_paths && looks_differ(scene))
    return "materials differ between frames, and frames share paths (\"bool sharepaths\" false parts them)";
  return {};
}

std::string why_not_in_waves(const Scene& scene, const PhotonSettings& settings) {
  const std::string why = why_not_by_settings(scene, settings);
  return why.empty() ? why_not_plain(scene) : why;
}

std::vector<PhotonTrace> trace_photons_in_waves(const Scene& scene, WaveTracer& tracer, const PhotonSettings& settings,
                                                std::uint64_t iteration, std::int64_t first, std::int64_t end,
                                                std::vector<PhotonTrace> reuse) {
  const PhotonStarts starts(scene, settings.share_paths);
  const Wavelength wavelength{.nm = scene.nm_of(settings.seed, iteration)};
  const PhotonWave wave{settings.max_depth, settings.least_alpha, settings.kinds, HuedWavelength(wavelength)};
  const std::int64_t each = settings.paths_per_trace;
  reuse.resize(static_cast<std::size_t>(chunk_count(end - first, each)));
  const auto make = [&](std::size_t t) {
    reuse[t].only_nm = wavelength.nm;
    auto trace = std::make_unique<TraceOfWaves>(scene, settings, starts, reuse[t]);
    const std::int64_t begin = first + static_cast<std::int64_t>(t) * each;
    trace->start(begin, std::min(begin + each, end), iteration);
    return trace;
  };
  const std::size_t at_once = std::max<std::size_t>(1, tracer.paths_at_once() / static_cast<std::size_t>(each));
  for (std::size_t t = 0; t < reuse.size(); t += at_once) {
    PartsOfWaves<TraceOfWaves, PhotonState> parts(t, std::min(t + at_once, reuse.size()), make);
    const PhotonWaves waves = tracer.trace(wave, parts.starts(scene.frames()));
    parts.for_each([&](TraceOfWaves& trace, const PartRange& range) { trace.keep(waves, range); });
    add_counts(waves, reuse[t]);
  }
  return reuse;
}

}  // namespace dspm
