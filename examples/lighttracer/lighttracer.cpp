// Integrator "lighttracer" "integer photons" 300000 "integer iterations" 64
//
// Follows photons from the lights. Wherever one is scattered, the light that goes straight to the camera is added to
// the pixel that sees the place. [Dutré et al. 1993] All frames at once: a photon path is one path as long as the
// frames meet the same; then it splits into copies with disjoint sets of frames. Left out are things seen in a mirror
// or through glass, and the lights themselves.
#include <dspm/base/system/parallel.h>
#include <dspm/integrators/summing_integrator.h>
#include <dspm/integrators/tiles.h>
#include <dspm/integrators/transport/branching_path.h>
#include <dspm/integrators/transport/roulette.h>
#include <dspm/session/modules/module.h>

namespace {

using namespace dspm;

class PhotonTracer {
 public:
  PhotonTracer(const Scene& scene, const RenderSettings& render, int photons, int max_depth)
      : scene_(scene), render_(render), photons_(photons), max_depth_(max_depth), branches_(scene, counts_) {}

  void trace(std::uint64_t path_index, int iteration) {
    const PathRandom random(render_.seed, Stream::photon, path_index, static_cast<std::uint64_t>(iteration));
    for (const LightChoice& choice : scene_.light_choices) {
      const ChosenLight chosen = choice.choose(random.number(0, kLightChoice));
      if (chosen.probability == 0) continue;
      const SceneLight& light = scene_.lights[static_cast<std::size_t>(chosen.index)];
      light.states.for_each(choice.frames, [&](FrameSet frames, const Light& state) {
        const auto start = state.emit(random.pair(0, kLightPoint), random.pair(0, kLightDirection));
        if (!start) return;
        const Spectrum flux =
            state.carried(start->flux, *scene_.palette) / (chosen.probability * static_cast<float>(photons_));
        PathState& path = branches_.push({start->ray, flux, frames});
        path.random = random;
        // Glass may refract by the iteration's wavelength, and colours what it refracts.
        path.wavelength = {.nm = scene_.nm_of(render_.seed, static_cast<std::uint64_t>(iteration)), .weighs = true};
      });
    }
    branches_.follow(*this);
    branches_.count_path();
  }

  // Called by branches_: where a path meets a surface, its frames may find different materials.
  void arrived(const PathState& path, const Vertex& vertex) {
    for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
      connect(path, frames, vertex, bsdf);
      if (path.bounces + 1 >= max_depth_) return;
      PathState next = path;
      next.frames = frames;
      const auto sample = sample_bsdf(bsdf, path, vertex.wo, Transport::flux, bsdf.all_lobes());
      if (!sample) return;
      extend(next, vertex, *sample);
      next.throughput *= shading_correction(vertex.point, vertex.wo, sample->wi);
      const float survival = std::min(1.f, max_component(next.throughput) / max_component(path.throughput));
      if (survives(next, survival, path.random.number(next.bounces, kRoulette))) branches_.push(next);
    });
  }
  void escaped(const PathState&, FrameSet) {}
  void lost(const PathState&, FrameSet, const SceneElement&) {}
  bool postpones(const PathState&, const HitPartition&) { return false; }

  const std::vector<SeenLight>& splats() const { return splats_; }
  const PathCounts& counts() const { return counts_; }

 private:
  void connect(const PathState& path, FrameSet frames, const Vertex& vertex, const Bsdf& bsdf) {
    const SurfacePoint& point = vertex.point;
    scene_.camera.for_each(frames, [&](FrameSet seeing, const Camera& camera) {
      const auto sight = camera.sight(point.p, path.random.pair(path.bounces + 1, kLightPoint));
      if (!sight) return;
      const Vec2 film = sight->film - render_.filter->sample(path.random.pair(path.bounces + 1, kLightDirection));
      const int x = static_cast<int>(std::floor(film.x)), y = static_cast<int>(std::floor(film.y));
      if (x < render_.crop.x0 || x >= render_.crop.x1 || y < render_.crop.y0 || y >= render_.crop.y1) return;
      const float cosine = std::abs(dot(sight->w, point.ns)) * shading_correction(point, vertex.wo, sight->w);
      const Spectrum radiance = path.throughput *
                                bsdf.evaluate(vertex.wo, sight->w, Transport::flux, bsdf.all_lobes()) *
                                (cosine * sight->pixels_per_area);
      if (is_black(radiance) || !is_finite(radiance)) return;
      const FrameSet open = seeing - scene_.accel->occluded(point.spawn(sight->w, sight->distance), seeing);
      if (!open.empty()) splats_.push_back({open, scene_.palette->seen(radiance), pixel_in_crop(render_.crop, x, y)});
    });
  }

  const Scene& scene_;
  const RenderSettings& render_;
  int photons_, max_depth_;
  std::vector<SeenLight> splats_;
  PathCounts counts_;
  BranchingPath<PathState> branches_;
};

class LightTracer final : public SummingIntegrator {
 public:
  LightTracer(int iterations, int photons, int max_depth, const Scene& scene, const RenderSettings& render)
      : SummingIntegrator(scene.frame_count(), render, at_start()),
        iterations_(iterations),
        photons_(photons),
        max_depth_(max_depth),
        render_(render) {}

  int iterations() const override { return iterations_; }
  std::string settings() const override { return std::to_string(photons_) + " photons per iteration"; }

  void iterate(const Iteration& iteration) override {
    done_.advance([&](SeenLightSums& sums, Statistics& statistics) {
      const StepTimer timer(statistics.steps[0]);
      for (const Chunk& chunk : traced(iteration)) {
        statistics.photon += chunk.counts;
        statistics.counters.add("splats", chunk.splats.size());
        for (const SeenLight& splat : chunk.splats) sums.add(splat);
      }
    });
  }

 private:
  struct Chunk {
    std::vector<SeenLight> splats;
    PathCounts counts;
  };

  static Statistics at_start() {
    Statistics statistics;
    statistics.steps = {{"photons"}};
    return statistics;
  }

  std::vector<Chunk> traced(const Iteration& iteration) const {
    constexpr int kGrain = 4096;  // fixed, so that sums have the same order with any number of threads
    std::vector<Chunk> chunks(static_cast<std::size_t>(chunk_count(photons_, kGrain)));
    parallel_chunks(photons_, kGrain, [&](std::int64_t begin, std::int64_t end) {
      PhotonTracer tracer(iteration.scene, render_, photons_, max_depth_);
      for (std::int64_t i = begin; i < end; ++i) tracer.trace(static_cast<std::uint64_t>(i), iteration.number);
      chunks[static_cast<std::size_t>(begin / kGrain)] = {tracer.splats(), tracer.counts()};
    });
    return chunks;
  }

  int iterations_, photons_, max_depth_;
  RenderSettings render_;
};

std::unique_ptr<Integrator> make_lighttracer(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  const int iterations = params.integer("iterations", 64, "", "of `photons` paths each; 0: until stopped");
  const int photons = params.integer("photons", 300'000, "", "paths per iteration");
  const int max_depth = params.integer("maxdepth", 8, "", "scattering events of a path");
  if (iterations < 0) params.error("iterations", "the number of iterations must not be negative");
  if (photons < 1 || max_depth < 1) params.error("photons", "photons and maxdepth must be at least 1");
  params.finish();
  return std::make_unique<LightTracer>(iterations, photons, max_depth, scene, render);
}

}  // namespace

DSPM_MODULE(registry) {
  registry.add(integrator_plugins(), {{"lighttracer", "photons that are connected to the camera", make_lighttracer}});
}
