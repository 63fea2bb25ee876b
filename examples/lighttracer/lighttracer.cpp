// Integrator "lighttracer" "integer photons" 300000 "integer iterations" 64
//
// Photons walk from the lights, and wherever they are scattered, what of them goes straight to the camera is added to
// the pixel that sees the place. [Dutré et al. 1993] All frames at once: a photon path is one path as long as the
// frames meet the same; where they part, so do copies of it, with disjoint sets of frames. What is seen in a mirror or
// through glass is left out, as are the lights themselves.
#include <dspm/integrators/path_step.h>
#include <dspm/integrators/tiles.h>
#include <dspm/modules/module.h>
#include <dspm/system/parallel.h>

namespace {

using namespace dspm;

struct Splat {
  int pixel;
  FrameSet frames;
  Rgb radiance;
};

class PhotonWalk {
 public:
  PhotonWalk(const Scene& scene, const RenderSettings& render, int max_depth)
      : scene_(scene), render_(render), max_depth_(max_depth) {}

  void trace(std::uint64_t path_index, int iteration) {
    const PathRandom random(render_.seed, Stream::photon, path_index, static_cast<std::uint64_t>(iteration));
    const ChosenLight chosen = scene_.choose_light(random.number(0, kLightChoice));
    if (chosen.probability == 0) return;
    const SceneLight& light = scene_.lights[static_cast<std::size_t>(chosen.index)];
    light.states.for_each(scene_.frames(), [&](FrameSet frames, const Light& state) {
      const auto start = state.emit(random.pair(0, kLightPoint), random.pair(0, kLightDirection));
      if (start) stack_.push({start->ray, start->flux / chosen.probability, frames});
    });
    while (!stack_.empty()) {
      const PathState path = stack_.pop();
      for (const FrameHit& part : scene_.accel->partition(path.ray, path.frames))
        if (!part.hit.missed()) scatter(path, part, random);
    }
  }

  const std::vector<Splat>& splats() const { return splats_; }

 private:
  void scatter(const PathState& path, const FrameHit& part, const PathRandom& random) {
    const SurfacePoint point = scene_.surface_point(part.hit);
    const Vec3 wo = -path.ray.direction;
    for_each_surface(scene_, part, point, [&](FrameSet frames, const Bsdf& bsdf) {
      connect(path, frames, point, bsdf, wo, random);
      if (path.bounces + 1 >= max_depth_) return;
      const auto sample = sample_bsdf(bsdf, wo, random, path.bounces + 1, Transport::flux, bsdf.all_lobes());
      if (!sample) return;
      PathState next = path;
      next.frames = frames;
      extend(next, point, *sample);
      next.throughput *= shading_correction(point, wo, sample->wi);
      const float survival = std::min(1.f, max_component(next.throughput) / max_component(path.throughput));
      if (survives(next, survival, random.number(next.bounces, kRoulette))) stack_.push(next);
    });
  }

  void connect(const PathState& path, FrameSet frames, const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
               const PathRandom& random) {
    scene_.camera.for_each(frames, [&](FrameSet seeing, const Camera& camera) {
      const auto sight = camera.sight(point.p, random.pair(path.bounces + 1, kLightPoint));
      if (!sight) return;
      const Vec2 film = sight->film - render_.filter->sample(random.pair(path.bounces + 1, kLightDirection));
      const int x = static_cast<int>(std::floor(film.x)), y = static_cast<int>(std::floor(film.y));
      if (x < render_.crop.x0 || x >= render_.crop.x1 || y < render_.crop.y0 || y >= render_.crop.y1) return;
      const float cosine = std::abs(dot(sight->w, point.ns)) * shading_correction(point, wo, sight->w);
      const Rgb radiance = path.throughput * bsdf.evaluate(wo, sight->w, Transport::flux, bsdf.all_lobes()) *
                           (cosine * sight->pixels_per_area);
      if (is_black(radiance) || !is_finite(radiance)) return;
      const FrameSet open = seeing - scene_.accel->occluded(point.spawn(sight->w, sight->distance), seeing);
      if (!open.empty()) splats_.push_back({pixel_in_crop(render_.crop, x, y), open, radiance});
    });
  }

  const Scene& scene_;
  const RenderSettings& render_;
  int max_depth_;
  PathStack<PathState> stack_;
  std::vector<Splat> splats_;
};

class LightTracer final : public Integrator {
 public:
  LightTracer(int iterations, int photons, int max_depth, const Scene& scene, const RenderSettings& render)
      : iterations_(iterations), photons_(photons), max_depth_(max_depth), scene_(scene), render_(render) {
    sums_.assign(static_cast<std::size_t>(scene.frame_count()), Image(render.crop.width(), render.crop.height()));
    statistics_.steps = {{"photons"}};
  }

  int iterations() const override { return iterations_; }
  std::string settings() const override { return std::to_string(photons_) + " photons an iteration"; }

  void iterate(int iteration) override {
    const StepTimer timer(statistics_.steps[0]);
    constexpr int kGrain = 4096;  // fixed, so that sums have the same order with any number of threads
    std::vector<PhotonWalk> walks(static_cast<std::size_t>(chunk_count(photons_, kGrain)),
                                  {scene_, render_, max_depth_});
    parallel_chunks(photons_, kGrain, [&](std::int64_t begin, std::int64_t end) {
      PhotonWalk& walk = walks[static_cast<std::size_t>(begin / kGrain)];
      for (std::int64_t i = begin; i < end; ++i) walk.trace(static_cast<std::uint64_t>(i), iteration);
    });
    for (const PhotonWalk& walk : walks)
      for (const Splat& splat : walk.splats())
        splat.frames.for_each([&](Frame frame) {
          sums_[static_cast<std::size_t>(frame)].pixels[static_cast<std::size_t>(splat.pixel)] += splat.radiance;
        });
    ++statistics_.iterations;
  }

  Image estimate(Frame frame) const override {
    Image image = sums_[static_cast<std::size_t>(frame)];
    const double paths = std::max(1.0, static_cast<double>(statistics_.iterations) * photons_);
    for (Rgb& c : image.pixels) c = c * static_cast<float>(1 / paths);
    return image;
  }

  Statistics statistics() const override { return statistics_; }
  bool persist(StateStream& state) override {
    for (Image& sum : sums_) state.part(sum.pixels);
    return statistics_.persist(state), true;
  }

 private:
  int iterations_, photons_, max_depth_;
  const Scene& scene_;
  RenderSettings render_;
  std::vector<Image> sums_;  // by frame
  Statistics statistics_;
};

std::unique_ptr<Integrator> make_lighttracer(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  const int iterations = params.integer("iterations", 64, "", "each of that many photons; 0: until stopped");
  const int photons = params.integer("photons", 300'000, "", "paths an iteration");
  const int max_depth = params.integer("maxdepth", 8, "", "scatterings of a path");
  if (iterations < 0) params.error("iterations", "the number of iterations must not be negative");
  if (photons < 1 || max_depth < 1) params.error("photons", "photons and maxdepth must be at least 1");
  params.finish();
  return std::make_unique<LightTracer>(iterations, photons, max_depth, scene, render);
}

}  // namespace

DSPM_MODULE(registry) {
  registry.add(integrator_plugins(), {{"lighttracer", "photons that are connected to the camera", make_lighttracer}});
}
