#include "dspm/integrators/photons/trace_photons.h"

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/photons/photon_energy.h"
#include "dspm/integrators/photons/seen_along.h"
#include "dspm/integrators/photons/start_photons.h"
#include "dspm/integrators/transport/branching_path.h"
#include "dspm/integrators/transport/joint_path.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/lobe_choice.h"
#include "dspm/integrators/transport/roulette_chance.h"

namespace dspm {
namespace {

class PhotonTracer {
 public:
  PhotonTracer(const Scene& scene, const PhotonSettings& settings, const PhotonStarts& starts, PhotonTrace& out)
      : scene_(scene),
        settings_(settings),
        starts_(starts),
        out_(out),
        writer_(scene, settings, out),
        energy_(scene.frame_count(), out),
        branches_(scene, out.paths) {
    wavelength_.weighs = settings.own_wavelengths;
  }

  void trace(std::uint64_t path_index, std::uint64_t iteration) {
    const PathRandom random = numbers_of(settings_, path_index, iteration);
    if (scene_.disperses)
      wavelength_.nm =
          settings_.own_wavelengths ? wavelength_at(static_cast<double>(random.number(0, kWavelength))) : out_.only_nm;
    start(random);
    branches_.follow(*this);
    branches_.count_path();
    if (settings_.keep_ends)
      out_.ends.push_back({out_.photons.size(), out_.hidden.size(), out_.on_curves.size(), out_.in_media.size()});
  }
  /// Call this after the last path.
  void finish() { energy_.finish(); }

 private:
  friend BranchingPath<PhotonPath>;
  friend MediumSegment<BranchingPath<PhotonPath>>;

  void start(const PathRandom& random) {
    start_photons(scene_, settings_, starts_, random, wavelength_, started_);
    for (const auto& [start, from, varied, is_valid] : started_) {
      if (!is_valid) {
        reject(start.frames, {SceneElement::Kind::light, from.index});
        continue;
      }
      PhotonPath& path = branches_.push(start);
      if (varied == nullptr || weigh(path, *varied, from))
        balance(path, path.frames, &EnergyBalance::emitted);
      else
        branches_.drop();
    }
  }

  /// Weights a photon that starts from the first state for each state of a light; returns whether any weight remains.
  bool weigh(PhotonPath& path, const SceneLight::Alike& alike, const PhotonOrigin& from) {
    FrameSet invalid;
    const auto weights = weights_of_states(*scene_.palette, alike, path.ray, from.flux, invalid);
    if (!invalid.empty()) reject(invalid, {SceneElement::Kind::light, from.index});
    return !weights.empty() && multiply(path, weights, out_.strands, ByRatio::yes, keep_all);
  }

  bool postpones(const PhotonPath&, const HitPartition&) { return false; }
  StrandTable& strands() { return out_.strands; }
  void dimmed(const PhotonPath& before, const PhotonPath& after) {
    const auto add = [&](const PhotonPath& path, double sign) {
      energy_.change(path.strands, path.frames, [&](EnergyBalance& e, const Spectrum& weight) {
        e.absorbed += sign * sum(path.throughput * weight);
      });
    };
    add(before, 1), add(after, -1);
  }

  void escaped(const PhotonPath& path, FrameSet frames) { balance(path, frames, &EnergyBalance::escaped); }

  void lost(const PhotonPath& path, FrameSet frames, const SceneElement& giver) {
    reject(frames, giver);
    balance(path, frames, &EnergyBalance::absorbed);
  }

  void wandered(const PhotonPath& before, const PhotonPath& after) {
    energy_.change(before.strands, after.frames, [&](EnergyBalance& e, const Spectrum& weight) {
      e.absorbed += sum(before.throughput * weight) - sum(after.throughput * weight);
    });
  }

  void collided(const PhotonPath& path, const MediumVertex& vertex) {
    if (path.bounces == 0 && vertex.distance < started(path).must_reach)
      return balance(path, path.frames, &EnergyBalance::absorbed);
    // What media scatter is diffuse.
    if ((settings_.kinds & kDiffusePhotons) == 0) return balance(path, path.frames, &EnergyBalance::terminated);
    writer_.store_in_medium(path, started(path), vertex);
    if (is_too_deep(path, path.frames)) return;
    for_each_phase(vertex, settings_.share_paths,
                   [&](const HenyeyGreenstein& phase, std::span<const FrameFactor> albedos) {
                     PhotonPath& branch = branches_.push(path);
                     branch.kind = kDiffusePhotons, branch.hidden = false;
                     extend_ray(branch, vertex, phase.sample(-vertex.wo, path.random.pair(path.bounces, kScatter)));
                     const float u = path.random.number(path.bounces, kRoulette);
                     if (!roulette(branch, vertex.scatterer(), albedos, u)) branches_.drop();
                   });
  }

  bool is_too_deep(const PhotonPath& path, FrameSet frames) {
    if (path.bounces + 1 < settings_.max_depth) return false;
    balance(path, frames, &EnergyBalance::too_deep), balance(path, frames, &EnergyBalance::terminated);
    return true;
  }

  void arrived(const PhotonPath& path, const Vertex& vertex) {
    if (path.bounces == 0 && vertex.hit.t < started(path).must_reach)
      return balance(path, vertex.frames, &EnergyBalance::absorbed);
    if (vertex.differs()) return scatter_together(path, vertex);
    PhotonWriter::Stored stored = writer_.stored_on_mixes(path, vertex);
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      writer_.add(stored, path, vertex, frames, bsdf);
      scatter(path, vertex, frames, bsdf, [&](const BsdfSample& sample, bool rough, const Spectrum& factor) {
        const FrameFactor all{frames, factor};
        extend(path, vertex, sample, rough, {&all, 1});
      });
    });
    writer_.store(path, started(path), vertex, stored);
  }

  [[gnu::noinline]] void scatter_together(const PhotonPath& path, const Vertex& vertex) {
    PhotonWriter::Stored stored = writer_.stored_on_mixes(path, vertex);
    FrameArray<Scattered> scattered;
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      writer_.add(stored, path, vertex, frames, bsdf);
      scatter(path, vertex, frames, bsdf, [&](const BsdfSample& sample, bool rough, const Spectrum& factor) {
        scattered.add({frames, factor, sample, rough});
      });
    });
    writer_.store(path, started(path), vertex, stored);
    for_each_joint(scattered, settings_.share_paths, [&](const Scattered& first, std::span<const FrameFactor> factors) {
      extend(path, vertex, first.sample, first.rough, factors);
    });
  }

  /// Calls fn(const BsdfSample&, rough, factor) unless these frames end.
  template <class Fn>
  void scatter(const PhotonPath& path, const Vertex& vertex, FrameSet frames, const Bsdf& bsdf, Fn&& fn) {
    if (is_too_deep(path, frames)) return;
    // Choose between smooth and rough lobes first, so that a photon knows which of them scattered it.
    const LobeChoice choice = choose_lobes(bsdf, path, vertex, settings_.least_alpha);
    const bool wanted = kind_after(path.kind, choice.rough) == kDiffusePhotons
                            ? (settings_.kinds & kDiffusePhotons) != 0
                            : path.caustics && vertex.shape.caustics;
    if (!wanted) return balance(path, frames, &EnergyBalance::terminated);
    const auto sample = sample_bsdf(bsdf, path, vertex.wo, Transport::flux, choice.lobes);
    const bool valid = !sample || is_finite(sample->wi);
    if (!valid) reject(frames, vertex.material_element());
    if (!sample || !valid) return balance(path, frames, &EnergyBalance::absorbed);
    const float correction = shading_correction(vertex.point, vertex.wo, sample->wi);
    fn(*sample, choice.rough, sample->weight * (correction / choice.chance));
  }

  void extend(const PhotonPath& path, const Vertex& vertex, const BsdfSample& sample, bool rough,
              std::span<const FrameFactor> factors) {
    PhotonPath& branch = branches_.push(path);
    branch.kind = kind_after(path.kind, rough);
    branch.hidden = path.hidden && sample.specular;
    if (settings_.keep_seen) branch.seen = seen_along(scene_, path, started(path), vertex, sample);
    extend_ray(branch, vertex, sample);
    if (!roulette(branch, vertex.material_element(), factors, path.random.number(path.bounces, kRoulette)))
      branches_.drop();
  }

  /// Multiplies by the factors, of `giver`. Returns whether the path survives in some of its frames.
  bool roulette(PhotonPath& path, const SceneElement& giver, std::span<const FrameFactor> factors, float u) {
    const auto left = [&](StrandList weights, FrameSet frames, const Spectrum& before, const Spectrum& after) {
      const bool valid = is_light(after);
      if (!valid) reject(frames, giver);
      const float p = valid ? std::min(1.f, max_component(after) / max_component(before)) : 0;
      const Spectrum surviving = left_by_roulette(after, p, u);
      EnergyBalance change;
      if (valid)
        change.absorbed = sum(before) - sum(after), change.roulette = sum(after) - sum(surviving);
      else
        change.terminated = sum(before);
      energy_.change(weights, frames,
                     [&](EnergyBalance& e, const Spectrum& grey) { e += change * static_cast<double>(grey[0]); });
      return surviving;
    };
    return multiply(path, factors, out_.strands, ByRatio::yes, left);
  }

  void reject(FrameSet frames, const SceneElement& giver) { out_.rejections.add(giver, frames); }
  void balance(const PhotonPath& path, FrameSet frames, double EnergyBalance::*entry) {
    energy_.add(path.strands, path.throughput, frames, entry);
  }

  const Scene& scene_;
  const PhotonSettings& settings_;
  const PhotonStarts& starts_;
  const PhotonOrigin& started(const PhotonPath& path) const {
    return started_[static_cast<std::size_t>(path.start)].from;
  }
  std::vector<StartedPhoton> started_;  // of the path that is traced
  Wavelength wavelength_;               // likewise
  PhotonTrace& out_;
  PhotonWriter writer_;
  PhotonEnergy energy_;
  BranchingPath<PhotonPath> branches_;
};

}  // namespace

void clear(PhotonTrace& trace, const StrandTable& of_lights) {
  trace.photons.clear();
  trace.hidden.clear();
  trace.on_curves.clear();
  trace.in_media.clear();
  trace.ends.clear();
  trace.seen.clear();
  trace.strands = of_lights, trace.own_strands = of_lights.end();
  trace.paths = {}, trace.stored = {}, trace.rejections = {};
}

void account(const std::vector<PhotonTrace>& traces, Statistics& statistics) {
  for (const PhotonTrace& trace : traces) {
    statistics.photon += trace.paths;
    statistics.photons_stored += trace.stored;
    statistics.rejections += trace.rejections;
    for (std::size_t f = 0; f < statistics.energy.size(); ++f) statistics.energy[f] += trace.energy[f];
  }
}

std::size_t bytes_of(const std::vector<PhotonTrace>& traces) {
  std::size_t sum = 0;
  for (const PhotonTrace& trace : traces)
    sum += (trace.photons.capacity() + trace.hidden.capacity()) * sizeof(Photon) +
           trace.on_curves.capacity() * sizeof(CurvePhoton) + trace.in_media.capacity() * sizeof(MediumPhoton) +
           trace.strands.bytes();
  return sum;
}

std::vector<PhotonTrace> trace_photons(const Scene& scene, const PhotonSettings& settings, std::uint64_t iteration,
                                       std::int64_t first, std::int64_t end, std::vector<PhotonTrace> reuse) {
  const PhotonStarts starts(scene, settings.share_paths);
  const std::int16_t only_nm = settings.own_wavelengths ? std::int16_t{0} : scene.nm_of(settings.seed, iteration);
  reuse.resize(static_cast<std::size_t>(chunk_count(end - first, settings.paths_per_trace)));
  parallel_chunks(end - first, settings.paths_per_trace, [&](std::int64_t chunk, std::int64_t chunk_end) {
    PhotonTrace& trace = reuse[static_cast<std::size_t>(chunk / settings.paths_per_trace)];
    clear(trace, starts.strands());
    trace.only_nm = only_nm;
    PhotonTracer tracer(scene, settings, starts, trace);
    for (std::int64_t i = first + chunk; i < first + chunk_end; ++i)
      tracer.trace(static_cast<std::uint64_t>(i), iteration);
    tracer.finish();
  });
  return reuse;
}

}  // namespace dspm
