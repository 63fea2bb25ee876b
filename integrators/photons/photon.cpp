#include "dspm/integrators/photons/photon.h"

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/photons/photon_energy.h"
#include "dspm/integrators/photons/photon_starts.h"
#include "dspm/integrators/transport/branching_path.h"
#include "dspm/integrators/transport/joint_path.h"
#include "dspm/integrators/transport/light_value.h"
#include "dspm/integrators/transport/mixed_frames.h"

namespace dspm {
namespace {

struct PhotonPath : PathState {
  unsigned kind = kDirectPhotons;
  int start = 0;         // index into the starts of this path
  bool hidden = false;   // see PhotonTrace::hidden
  bool caustics = true;  // see SceneLight
};

unsigned kind_after(const PhotonPath& path, bool rough) {
  return rough || path.kind == kDiffusePhotons ? kDiffusePhotons : kCausticPhotons;
}

class PhotonTracer {
 public:
  PhotonTracer(const Scene& scene, const PhotonSettings& settings, const PhotonStarts& starts, PhotonTrace& out)
      : scene_(scene),
        settings_(settings),
        starts_(starts),
        out_(out),
        energy_(scene.frame_count(), out),
        branches_(scene, out.paths) {}

  void trace(std::uint64_t path_index, std::uint64_t iteration) {
    start(PathRandom(settings_.seed, settings_.stream, path_index, iteration));
    branches_.follow(*this);
    branches_.count_path();
    if (settings_.keep_ends) out_.ends.push_back({out_.photons.size(), out_.hidden.size(), out_.on_curves.size()});
  }
  /// Call this after the last path.
  void finish() { energy_.finish(); }

 private:
  friend BranchingPath<PhotonPath>;

  void start(const PathRandom& random) {
    started_.clear();
    for (std::size_t choice = 0; choice < scene_.light_choices.size(); ++choice)
      if (!(scene_.light_choices[choice].frames & settings_.frames).empty()) start(random, choice);
  }

  void start(const PathRandom& random, std::size_t choice) {
    const EmissionStart chosen = start_of(settings_.guides, scene_, choice, random);
    if (chosen.density == 0) return;
    const SceneLight& light = scene_.lights[static_cast<std::size_t>(chosen.light)];
    const EmissionNumbers& u = chosen.numbers;
    for (const PhotonStart& start : starts_.of(choice, chosen.light)) {
      const FrameSet frames = start.frames & settings_.frames;
      if (frames.empty()) continue;
      const auto emission = start.light->emit({u[0], u[1]}, {u[2], u[3]});
      if (!emission || is_black(emission->flux)) continue;
      const Rgb flux = emission->flux * start.factor / chosen.density;
      if (!is_light(flux) || !is_finite(emission->ray)) {
        reject(frames, {SceneElement::Kind::light, chosen.light});
        continue;
      }
      PhotonPath& path = branches_.push({{emission->ray, flux, frames}});
      path.start = static_cast<int>(started_.size());
      started_.push_back({light,
                          *start.light,
                          {emission->ray, emission->normal, emission->primitive},
                          emission->must_reach,
                          chosen.light});
      path.random = random, path.strands = start.strands, path.inside = start.inside;
      path.hidden = settings_.hidden && light.is_delta, path.caustics = light.caustics;
      if (start.varied != nullptr && !weigh(path, *start.varied, chosen.light)) {
        branches_.drop();
        continue;
      }
      balance(path, path.frames, &EnergyBalance::emitted);
    }
  }

  /// Weights a photon that starts from the first state for each state of a light; returns whether any weight remains.
  bool weigh(PhotonPath& path, const SceneLight::Alike& alike, int index) {
    FrameArray<FrameFactor> weights;
    for (const auto& [frames, light] : alike.states) {
      const Rgb weight = light->ratio_along(*alike.first, path.ray);
      if (is_light(weight))
        weights.add({frames, weight});
      else
        reject(frames, {SceneElement::Kind::light, index});
    }
    return !weights.empty() && multiply(path, weights, out_.strands, ByRatio::yes, keep_all);
  }

  bool postpones(const PhotonPath&, const HitPartition&) { return false; }
  StrandTable& strands() { return out_.strands; }
  void dimmed(const PhotonPath& before, const PhotonPath& after) {
    const auto add = [&](const PhotonPath& path, double sign) {
      energy_.change(path.strands, path.frames,
                     [&](EnergyBalance& e, const Rgb& weight) { e.absorbed += sign * sum(path.throughput * weight); });
    };
    add(before, 1), add(after, -1);
  }

  void escaped(const PhotonPath& path, FrameSet frames) { balance(path, frames, &EnergyBalance::escaped); }

  void lost(const PhotonPath& path, FrameSet frames, const SceneElement& giver) {
    reject(frames, giver);
    balance(path, frames, &EnergyBalance::absorbed);
  }

  void wandered(const PhotonPath& before, const PhotonPath& after) {
    energy_.change(before.strands, after.frames, [&](EnergyBalance& e, const Rgb& weight) {
      e.absorbed += sum(before.throughput * weight) - sum(after.throughput * weight);
    });
  }

  void arrived(const PhotonPath& path, const Vertex& vertex) {
    if (path.bounces == 0 && vertex.hit.t < started(path).must_reach)
      return balance(path, vertex.frames, &EnergyBalance::absorbed);
    if (vertex.differs()) return scatter_together(path, vertex);
    Stored stored = stored_on_mixes(path, vertex);
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      add(stored, path, vertex, frames, bsdf);
      scatter(path, vertex, frames, bsdf, [&](const BsdfSample& sample, bool rough, const Rgb& factor) {
        const FrameFactor all{frames, factor};
        extend(path, vertex, sample, rough, {&all, 1});
      });
    });
    store(path, vertex, stored);
  }

  [[gnu::noinline]] void scatter_together(const PhotonPath& path, const Vertex& vertex) {
    Stored stored = stored_on_mixes(path, vertex);
    FrameArray<Scattered> scattered;
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      add(stored, path, vertex, frames, bsdf);
      scatter(path, vertex, frames, bsdf, [&](const BsdfSample& sample, bool rough, const Rgb& factor) {
        scattered.add({frames, factor, sample, rough});
      });
    });
    store(path, vertex, stored);
    for_each_joint(scattered, settings_.share_paths, [&](const Scattered& first, std::span<const FrameFactor> factors) {
      extend(path, vertex, first.sample, first.rough, factors);
    });
  }

  /// The frames in which the surface gathers, or may gather right beside the point.
  struct Stored {
    FrameSet gathering, hidden;
  };
  bool gathers(const Vertex& vertex, const Bsdf& bsdf) const {
    return gathering_lobes(bsdf, vertex.point, settings_.least_alpha) != 0;
  }
  Stored stored_on_mixes(const PhotonPath& path, const Vertex& vertex) const {
    return {mixed_frames(vertex, [&](const Bsdf& bsdf) { return gathers(vertex, bsdf); }),
            mixed_frames(vertex, [&](const Bsdf& bsdf) { return is_hidden_on(path, vertex, bsdf); })};
  }
  void add(Stored& stored, const PhotonPath& path, const Vertex& vertex, FrameSet frames, const Bsdf& bsdf) const {
    if (gathers(vertex, bsdf)) stored.gathering |= frames;
    if (is_hidden_on(path, vertex, bsdf)) stored.hidden |= frames;
  }
  void store(const PhotonPath& path, const Vertex& vertex, const Stored& stored) {
    if (!stored.gathering.empty() && is_wanted(path)) store(out_.photons, path, vertex, stored.gathering);
    if (stored.hidden.empty()) return;
    if (vertex.point.turns)
      store_on_curve(path, vertex, stored.hidden);
    else
      store(out_.hidden, path, vertex, stored.hidden);
  }
  bool is_wanted(const PhotonPath& path) const {
    if (path.kind == kDirectPhotons && settings_.rays_tell && is_told_by_a_ray(scene_, started(path).light))
      return false;
    return (path.kind & settings_.kinds) != 0;
  }
  /// Excludes light straight from the light source, which shadow rays find.
  bool is_hidden_on(const PhotonPath& path, const Vertex& vertex, const Bsdf& bsdf) const {
    return path.hidden && path.bounces > 0 && glossy_lobes(bsdf, vertex.point, settings_.least_alpha) != 0;
  }

  void store(std::vector<Photon>& photons, const PhotonPath& path, const Vertex& vertex, FrameSet frames) {
    const SurfacePoint& point = vertex.point;
    const Vec3& wi = vertex.wo;
    Rgb flux = path.throughput;
    if (const Vec3& ns = unbent_normal(point); !(ns == point.ng)) {
      // If the normals disagree about the side, every scattering function is zero.
      const float geometric = dot(wi, point.ng), shading = dot(wi, ns);
      if (!(geometric * shading > 0)) return;
      flux *= shading / geometric;
    }
    if (path.kind == kDirectPhotons && settings_.direct != nullptr) flux *= weight_of_direct(path, point);
    photons.push_back(photon(path, vertex, flux, frames));
    count(photons.back());
  }

  void store_on_curve(const PhotonPath& path, const Vertex& vertex, FrameSet frames) {
    out_.on_curves.push_back(
        {photon(path, vertex, path.throughput, frames), StripPlace(vertex.shape, vertex.hit, vertex.wo), path.bounces});
    count(out_.on_curves.back());
  }

  Photon photon(const PhotonPath& path, const Vertex& vertex, Rgb flux, FrameSet frames) {
    const StrandList strands = out_.strands.folded(path.strands, frames, flux);
    const ShapeFace face(vertex.hit.shape, vertex.point.ng, vertex.wo);
    return {vertex.point.p, face, vertex.wo, flux, frames, strands, started(path).index};
  }

  void count(const Photon& stored) {
    out_.stored.add(stored.frames.count());
    out_.paths.weighted += stored.strands != 0;
  }

  float weight_of_direct(const PhotonPath& path, const SurfacePoint& point) const {
    const Started& from = started(path);
    return settings_.direct->weight_of_photon(from.light, from.state, from.start, {point.p, point.ng});
  }

  /// Calls fn(const BsdfSample&, rough, factor) unless these frames end.
  template <class Fn>
  void scatter(const PhotonPath& path, const Vertex& vertex, FrameSet frames, const Bsdf& bsdf, Fn&& fn) {
    if (path.bounces + 1 >= settings_.max_depth) {
      balance(path, frames, &EnergyBalance::too_deep);
      return balance(path, frames, &EnergyBalance::terminated);
    }
    // Choose between smooth and rough lobes first, so that a photon knows which of them scattered it.
    const LobeChoice choice = choose_lobes(bsdf, path, vertex, settings_.least_alpha);
    const bool wanted = kind_after(path, choice.rough) == kDiffusePhotons ? (settings_.kinds & kDiffusePhotons) != 0
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
    branch.kind = kind_after(path, rough);
    branch.hidden = path.hidden && sample.specular;
    extend_ray(branch, vertex, sample);
    if (!roulette(branch, vertex, factors, path.random.number(path.bounces, kRoulette))) branches_.drop();
  }

  /// Multiplies by the factors. Returns whether the path survives in some of its frames.
  bool roulette(PhotonPath& path, const Vertex& vertex, std::span<const FrameFactor> factors, float u) {
    const auto left = [&](StrandList weights, FrameSet frames, const Rgb& before, const Rgb& after) {
      const bool valid = is_light(after);
      if (!valid) reject(frames, vertex.material_element());
      const float p = valid ? std::min(1.f, max_component(after) / max_component(before)) : 0;
      const Rgb surviving = p >= 1 ? after : u < p ? after * (1 / p) : Rgb();
      EnergyBalance change;
      if (valid)
        change.absorbed = sum(before) - sum(after), change.roulette = sum(after) - sum(surviving);
      else
        change.terminated = sum(before);
      energy_.change(weights, frames,
                     [&](EnergyBalance& e, const Rgb& grey) { e += change * static_cast<double>(grey.r); });
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
  struct Started {
    const SceneLight& light;
    const Light& state;
    LightStart start;
    float must_reach;
    int index;  // of the light
  };
  const Started& started(const PhotonPath& path) const { return started_[static_cast<std::size_t>(path.start)]; }
  std::vector<Started> started_;  // of the path that is traced
  PhotonTrace& out_;
  PhotonEnergy energy_;
  BranchingPath<PhotonPath> branches_;
};

void clear(PhotonTrace& trace, const StrandTable& of_lights) {
  trace.photons.clear();
  trace.hidden.clear();
  trace.on_curves.clear();
  trace.ends.clear();
  trace.strands = of_lights, trace.own_strands = of_lights.end();
  trace.paths = {}, trace.stored = {}, trace.rejections = {};
}

}  // namespace

std::vector<PhotonTrace> trace_photons(const Scene& scene, const PhotonSettings& settings, std::uint64_t iteration,
                                       std::int64_t first, std::int64_t end, std::vector<PhotonTrace> reuse) {
  const PhotonStarts starts(scene, settings.share_paths);
  reuse.resize(static_cast<std::size_t>(chunk_count(end - first, settings.paths_per_trace)));
  parallel_chunks(end - first, settings.paths_per_trace, [&](std::int64_t chunk, std::int64_t chunk_end) {
    PhotonTrace& trace = reuse[static_cast<std::size_t>(chunk / settings.paths_per_trace)];
    clear(trace, starts.strands());
    PhotonTracer tracer(scene, settings, starts, trace);
    for (std::int64_t i = first + chunk; i < first + chunk_end; ++i)
      tracer.trace(static_cast<std::uint64_t>(i), iteration);
    tracer.finish();
  });
  return reuse;
}

}  // namespace dspm
