#include "integrators/photon.h"

#include "core/parallel.h"
#include "integrators/path_step.h"

namespace dspm {
namespace {

constexpr std::int64_t kPathsPerChunk = 2048;

struct PhotonPath : PathState {
  unsigned kind = kDirectPhotons;
};

double sum(const Rgb& c) { return static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b); }

class PhotonTracer {
 public:
  PhotonTracer(const Scene& scene, const PhotonSettings& settings, PhotonTrace& out)
      : scene_(scene), settings_(settings), frames_(scene.frames()), out_(out) {}

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
    const SceneLight& light = scene_.lights[static_cast<std::size_t>(chosen.index)];
    const Vec2 u_point = random.pair(0, kLightPoint), u_direction = random.pair(0, kLightDirection);
    light.states.for_each(frames_, [&](FrameSet frames, const Light& state) {
      const auto emission = state.emit(u_point, u_direction);
      if (!emission || is_black(emission->flux)) return;
      const Rgb flux = emission->flux / chosen.probability;
      if (!is_finite(flux)) return reject(frames);
      balance(frames, [&](EnergyBalance& e) { e.emitted += sum(flux); });
      stack_.push({{emission->ray, flux, frames}, kDirectPhotons});
    });
  }

  void follow(const PhotonPath& path, const FrameHit& part, const PathRandom& random) {
    if (part.hit.missed()) return balance(part.frames, [&](EnergyBalance& e) { e.escaped += sum(path.throughput); });
    for_each_surface(scene_, part, [&](FrameSet frames, const SurfacePoint& point, const Bsdf& bsdf) {
      met_dynamic_ |= frames != frames_;
      PhotonPath& branch = stack_.push(path);
      branch.frames = frames;
      const Vec3 wo = -path.ray.direction;
      store(branch, point, bsdf, wo);
      if (!scatter(branch, point, bsdf, wo, random)) stack_.drop();
    });
  }

  void store(const PhotonPath& path, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wi) {
    if ((path.kind & settings_.kinds) == 0) return;
    if (bsdf.lobes(settings_.least_alpha) == 0) return;
    Rgb flux = path.throughput;
    if (!(point.ns == point.ng)) {
      // Where the normals disagree about the side, no scattering function gives anything.
      const float geometric = dot(wi, point.ng), shading = dot(wi, point.ns);
      if (!(geometric * shading > 0)) return;
      flux *= shading / geometric;
    }
    out_.photons.push_back({point.p, wi, flux, path.frames});
    out_.stored.add(path.frames.count());
  }

  /// Whether the path goes on.
  bool scatter(PhotonPath& path, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
               const PathRandom& random) {
    const double before = sum(path.throughput);
    const auto account = [&](double absorbed, double terminated) {
      balance(path.frames, [&](EnergyBalance& e) { e.absorbed += absorbed, e.terminated += terminated; });
      return false;
    };
    const int bounce = path.bounces;
    if (bounce + 1 >= settings_.max_depth) return account(0, before);

    // Smooth and rough lobes are told apart first, so that a photon knows which of them scattered it.
    const LobeChoice choice = choose_lobes(bsdf, wo, settings_.least_alpha, random, bounce);
    path.kind = choice.rough || path.kind == kDiffusePhotons ? kDiffusePhotons : kCausticPhotons;
    if (path.kind == kDiffusePhotons && !(settings_.kinds & kDiffusePhotons)) return account(0, before);

    const auto sample = sample_bsdf(bsdf, wo, random, bounce, Transport::flux, choice.lobes);
    if (!sample) return account(before, 0);
    const float largest = max_component(path.throughput);
    extend(path, point, *sample);
    path.throughput *= shading_correction(point, wo, sample->wi) / choice.chance;
    if (!is_finite(path.throughput)) {
      reject(path.frames);
      return account(0, before);
    }
    const double scattered = sum(path.throughput);
    const float p = std::min(1.f, max_component(path.throughput) / largest);
    const bool alive = p > 0 && survives(path, p, random.number(bounce, kRoulette));
    account(before - scattered, alive ? scattered - sum(path.throughput) : scattered);
    return alive;
  }

  void reject(FrameSet frames) { out_.invalid += static_cast<std::uint64_t>(frames.count()); }

  /// Frames in the full set share one balance, the last; it is added to each of them in the end.
  template <class Fn>
  void balance(FrameSet frames, Fn&& fn) {
    if (frames == frames_) return fn(out_.energy.back());
    frames.for_each([&](Frame f) { fn(out_.energy[static_cast<std::size_t>(f)]); });
  }

  const Scene& scene_;
  const PhotonSettings& settings_;
  FrameSet frames_;
  PhotonTrace& out_;
  PathStack<PhotonPath> stack_;
  bool met_dynamic_ = false;
};

void clear(PhotonTrace& trace, int frames) {
  trace.photons.clear();
  trace.paths = {}, trace.stored = {}, trace.invalid = 0;
  trace.energy.assign(static_cast<std::size_t>(frames) + 1, {});
}

void finish_balance(PhotonTrace& trace, FrameSet frames) {
  const EnergyBalance shared = trace.energy.back();
  trace.energy.pop_back();
  frames.for_each([&](Frame f) { trace.energy[static_cast<std::size_t>(f)] += shared; });
}

}  // namespace

void account(const std::vector<PhotonTrace>& traces, Statistics& statistics) {
  for (const PhotonTrace& trace : traces) {
    statistics.photon += trace.paths;
    statistics.photons_stored += trace.stored;
    statistics.invalid += trace.invalid;
    for (std::size_t f = 0; f < statistics.energy.size(); ++f) statistics.energy[f] += trace.energy[f];
  }
}

std::size_t bytes_of(const std::vector<PhotonTrace>& traces) {
  std::size_t sum = 0;
  for (const PhotonTrace& trace : traces) sum += trace.photons.capacity() * sizeof(Photon);
  return sum;
}

std::vector<PhotonTrace> trace_photons(const Scene& scene, const PhotonSettings& settings, std::uint64_t iteration,
                                       std::int64_t first, std::int64_t end, std::vector<PhotonTrace> reuse) {
  reuse.resize(static_cast<std::size_t>(chunk_count(end - first, kPathsPerChunk)));
  parallel_chunks(end - first, kPathsPerChunk, [&](std::int64_t chunk, std::int64_t chunk_end) {
    PhotonTrace& trace = reuse[static_cast<std::size_t>(chunk / kPathsPerChunk)];
    clear(trace, scene.frame_count());
    PhotonTracer tracer(scene, settings, trace);
    for (std::int64_t i = first + chunk; i < first + chunk_end; ++i)
      tracer.trace(static_cast<std::uint64_t>(i), iteration);
    finish_balance(trace, scene.frames());
  });
  return reuse;
}

}  // namespace dspm
