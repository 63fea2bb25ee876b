#include "dspm/integrators/photon.h"

#include "dspm/colour/rgb.h"
#include "dspm/integrators/joint_path.h"
#include "dspm/integrators/photon_starts.h"
#include "dspm/math/frames.h"
#include "dspm/math/vec.h"
#include "dspm/system/parallel.h"

namespace dspm {
namespace {

constexpr std::int64_t kPathsPerChunk = 2048;

struct PhotonPath : PathState {
  unsigned kind = kDirectPhotons;
  bool hidden = false;  // see PhotonTrace::hidden
};

unsigned kind_after(const PhotonPath& path, bool rough) {
  return rough || path.kind == kDiffusePhotons ? kDiffusePhotons : kCausticPhotons;
}

double sum(const Rgb& c) { return static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b); }

class PhotonTracer {
 public:
  PhotonTracer(const Scene& scene, const PhotonSettings& settings, const PhotonStarts& starts, PhotonTrace& out)
      : scene_(scene), settings_(settings), starts_(starts), frames_(scene.frames()), out_(out) {}

  void trace(std::uint64_t path_index, std::uint64_t iteration) {
    const PathRandom random(settings_.seed, settings_.stream, path_index, iteration);
    start(random);
    ++out_.paths.paths;
    met_dynamic_ = false;
    while (!stack_.empty()) {
      const PhotonPath path = stack_.pop();
      met_dynamic_ |= path.frames != frames_;
      const HitPartition parts = scene_.accel->partition(path.ray, path.frames);
      out_.paths.segments.add(path.frames.count());
      for (const FrameHit& part : parts) follow(path, part, random);
    }
    out_.paths.dynamic_paths += met_dynamic_;
  }

 private:
  void start(const PathRandom& random) {
    const ChosenLight chosen = scene_.choose_light(random.number(0, kLightChoice));
    if (chosen.probability == 0) return;
    const Vec2 u_point = random.pair(0, kLightPoint), u_direction = random.pair(0, kLightDirection);
    for (const PhotonStart& start : starts_.of(chosen.index)) {
      const auto emission = start.light->emit(u_point, u_direction);
      if (!emission || is_black(emission->flux)) continue;
      const Rgb flux = emission->flux * start.factor / chosen.probability;
      if (!is_finite(flux) || !is_finite(emission->ray)) {
        reject(start.frames, {ScenePart::Kind::light, chosen.index});
        continue;
      }
      PhotonPath& path = stack_.push({{emission->ray, flux, start.frames}, kDirectPhotons});
      path.strands = start.strands;
      path.hidden = settings_.hidden && scene_.lights[static_cast<std::size_t>(chosen.index)].is_delta;
      if (start.varied != nullptr && !weigh(path, *start.varied, chosen.index)) {
        stack_.drop();
        continue;
      }
      balance(path, path.frames, &EnergyBalance::emitted);
    }
  }

  /// Gives each state of a light its share of a photon that starts as the first's; whether any has one.
  bool weigh(PhotonPath& path, const SceneLight::Alike& alike, int index) {
    FrameArray<FrameFactor> weights;
    for (const auto& [frames, light] : alike.states) {
      const Rgb weight = light->ratio_along(*alike.first, path.ray);
      if (is_finite(weight))
        weights.add({frames, weight});
      else
        reject(frames, {ScenePart::Kind::light, index});
    }
    return !weights.empty() && multiply(path, weights, out_.strands, ByRatio::yes, keep_all);
  }

  void follow(const PhotonPath& path, const FrameHit& part, const PathRandom& random) {
    if (part.hit.missed()) return balance(path, part.frames, &EnergyBalance::escaped);
    met_ = &part.hit;
    const Vec3 wo = -path.ray.direction;
    const SurfacePoint point = scene_.surface_point(part.hit);
    if (!is_finite(point)) {
      reject(part.frames, shape_part(part.hit));
      return balance(path, part.frames, &EnergyBalance::absorbed);
    }
    if (material_at(scene_, part.hit).differs_in(part.frames)) return follow_together(path, part, point, wo, random);
    for_each_surface(scene_, part, point, [&](FrameSet frames, const Bsdf& bsdf) {
      if (bsdf.lobes(settings_.least_alpha) != 0) store(path, frames, point, wo);
      if (is_hidden_on(path, bsdf)) store_hidden(path, frames, point, wo);
      way_on(path, frames, bsdf, point, wo, random, [&](const BsdfSample& sample, bool rough, const Rgb& factor) {
        const FrameFactor all{frames, factor};
        go_on(path, point, sample, rough, {&all, 1}, random);
      });
    });
  }

  [[gnu::noinline]] void follow_together(const PhotonPath& path, const FrameHit& part, const SurfacePoint& point,
                                         const Vec3& wo, const PathRandom& random) {
    FrameSet gathering, hidden;
    FrameArray<Way> ways;
    for_each_surface(scene_, part, point, [&](FrameSet frames, const Bsdf& bsdf) {
      if (bsdf.lobes(settings_.least_alpha) != 0) gathering |= frames;
      if (is_hidden_on(path, bsdf)) hidden |= frames;
      way_on(path, frames, bsdf, point, wo, random, [&](const BsdfSample& sample, bool rough, const Rgb& factor) {
        ways.add({frames, factor, sample, rough});
      });
    });
    if (!gathering.empty()) store(path, gathering, point, wo);
    if (!hidden.empty()) store_hidden(path, hidden, point, wo);
    for_each_joint(ways, settings_.share_paths, [&](const Way& first, std::span<const FrameFactor> factors) {
      go_on(path, point, first.sample, first.rough, factors, random);
    });
  }

  void store(const PhotonPath& path, FrameSet frames, const SurfacePoint& point, const Vec3& wi) {
    if ((path.kind & settings_.kinds) != 0) store(out_.photons, path, frames, point, wi);
  }
  void store_hidden(const PhotonPath& path, FrameSet frames, const SurfacePoint& point, const Vec3& wi) {
    store(out_.hidden, path, frames, point, wi);
  }
  /// Light that comes straight from the light is found by shadow rays.
  bool is_hidden_on(const PhotonPath& path, const Bsdf& bsdf) const {
    return path.hidden && path.bounces > 0 && glossy_lobes(bsdf, settings_.least_alpha) != 0;
  }

  void store(std::vector<Photon>& photons, const PhotonPath& path, FrameSet frames, const SurfacePoint& point,
             const Vec3& wi) {
    Rgb flux = path.throughput;
    if (!(point.ns == point.ng)) {
      // Where the normals disagree about the side, no scattering function gives anything.
      const float geometric = dot(wi, point.ng), shading = dot(wi, point.ns);
      if (!(geometric * shading > 0)) return;
      flux *= shading / geometric;
    }
    const StrandList strands = out_.strands.folded(path.strands, frames, flux);
    photons.push_back({point.p, wi, flux, frames, strands});
    out_.stored.add(frames.count());
    out_.paths.weighted += strands != 0;
  }

  /// Calls fn(const BsdfSample&, rough, factor) unless these frames end.
  template <class Fn>
  void way_on(const PhotonPath& path, FrameSet frames, const Bsdf& bsdf, const SurfacePoint& point, const Vec3& wo,
              const PathRandom& random, Fn&& fn) {
    const int bounce = path.bounces;
    if (bounce + 1 >= settings_.max_depth) return balance(path, frames, &EnergyBalance::terminated);
    // Smooth and rough lobes are told apart first, so that a photon knows which of them scattered it.
    const LobeChoice choice = choose_lobes(bsdf, wo, settings_.least_alpha, random, bounce);
    if (kind_after(path, choice.rough) == kDiffusePhotons && !(settings_.kinds & kDiffusePhotons))
      return balance(path, frames, &EnergyBalance::terminated);
    const auto sample = sample_bsdf(bsdf, wo, random, bounce, Transport::flux, choice.lobes);
    const bool valid = !sample || is_finite(sample->wi);
    if (!valid) reject(frames, material_part(scene_, *met_));
    if (!sample || !valid) return balance(path, frames, &EnergyBalance::absorbed);
    fn(*sample, choice.rough, sample->weight * (shading_correction(point, wo, sample->wi) / choice.chance));
  }

  void go_on(const PhotonPath& path, const SurfacePoint& point, const BsdfSample& sample, bool rough,
             std::span<const FrameFactor> factors, const PathRandom& random) {
    PhotonPath& branch = stack_.push(path);
    branch.kind = kind_after(path, rough);
    branch.hidden = path.hidden && sample.specular;
    move_on(branch, point, sample);
    if (!scatter(branch, factors, random.number(path.bounces, kRoulette))) stack_.drop();
  }

  /// Whether the path goes on, in some of its frames.
  bool scatter(PhotonPath& path, std::span<const FrameFactor> factors, float u) {
    met_dynamic_ |= factors[0].frames != frames_;
    const auto roulette = [&](StrandList weights, FrameSet frames, const Rgb& before, const Rgb& after) {
      const bool valid = is_finite(after);
      if (!valid) reject(frames, material_part(scene_, *met_));
      const float p = valid ? std::min(1.f, max_component(after) / max_component(before)) : 0;
      const Rgb left = p >= 1 ? after : u < p ? after * (1 / p) : Rgb();
      EnergyBalance change;
      if (valid)
        change.absorbed = sum(before) - sum(after), change.roulette = sum(after) - sum(left);
      else
        change.terminated = sum(before);
      balance(weights, frames, [&](EnergyBalance& e, const Rgb& grey) { e += change * static_cast<double>(grey.r); });
      return left;
    };
    return multiply(path, factors, out_.strands, ByRatio::yes, roulette);
  }

  void reject(FrameSet frames, const ScenePart& giver) { out_.rejections.add(giver, frames); }

  /// Adds what these frames of the path carry.
  void balance(const PhotonPath& path, FrameSet frames, double EnergyBalance::*entry) {
    balance(path.strands, frames,
            [&](EnergyBalance& e, const Rgb& weight) { e.*entry += sum(path.throughput * weight); });
  }
  /// Calls fn(balance, weight) for these frames. What all frames have by a grey list of a light has a balance of its
  /// own, which comes to that of the frames in the end.
  template <class Fn>
  void balance(StrandList weights, FrameSet frames, Fn&& fn) {
    const Strand* list = out_.strands.of(weights);
    if (frames == frames_ && weights < out_.own_strands && (list == nullptr || list->grey))
      return fn(out_.energy[static_cast<std::size_t>(scene_.frame_count()) + weights], Rgb(1));
    for_each_strand(list, frames, [&](FrameSet alike, const Rgb& weight) {
      alike.for_each([&](Frame f) { fn(out_.energy[static_cast<std::size_t>(f)], weight); });
    });
  }

  const Scene& scene_;
  const PhotonSettings& settings_;
  const PhotonStarts& starts_;
  FrameSet frames_;
  PhotonTrace& out_;
  PathStack<PhotonPath> stack_;
  const RayHit* met_ = nullptr;  // where the path just now has arrived
  bool met_dynamic_ = false;
};

void clear(PhotonTrace& trace, const StrandTable& of_lights, int frames) {
  trace.photons.clear();
  trace.hidden.clear();
  trace.strands = of_lights, trace.own_strands = of_lights.end();
  trace.paths = {}, trace.stored = {}, trace.rejections = {};
  trace.energy.assign(static_cast<std::size_t>(frames) + trace.own_strands, {});
}

void finish_balance(PhotonTrace& trace, int frames) {
  for (StrandList list = 0; list < trace.own_strands; ++list) {
    const EnergyBalance shared = trace.energy[static_cast<std::size_t>(frames) + list];
    if (shared == EnergyBalance{}) continue;
    for_each_strand(trace.strands.of(list), FrameSet::first(frames), [&](FrameSet alike, const Rgb& grey) {
      alike.for_each(
          [&](Frame f) { trace.energy[static_cast<std::size_t>(f)] += shared * static_cast<double>(grey.r); });
    });
  }
  trace.energy.resize(static_cast<std::size_t>(frames));
}

}  // namespace

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
    sum += (trace.photons.capacity() + trace.hidden.capacity()) * sizeof(Photon) + trace.strands.bytes();
  return sum;
}

std::vector<PhotonTrace> trace_photons(const Scene& scene, const PhotonSettings& settings, std::uint64_t iteration,
                                       std::int64_t first, std::int64_t end, std::vector<PhotonTrace> reuse) {
  const PhotonStarts starts(scene, settings.share_paths);
  reuse.resize(static_cast<std::size_t>(chunk_count(end - first, kPathsPerChunk)));
  parallel_chunks(end - first, kPathsPerChunk, [&](std::int64_t chunk, std::int64_t chunk_end) {
    PhotonTrace& trace = reuse[static_cast<std::size_t>(chunk / kPathsPerChunk)];
    clear(trace, starts.strands(), scene.frame_count());
    PhotonTracer tracer(scene, settings, starts, trace);
    for (std::int64_t i = first + chunk; i < first + chunk_end; ++i)
      tracer.trace(static_cast<std::uint64_t>(i), iteration);
    finish_balance(trace, scene.frame_count());
  });
  return reuse;
}

}  // namespace dspm
