// Integrator "ambient" "float distance" 2 "integer iterations" 64
//
// Ambient occlusion: how much of the sky each surface sees; white if all of it. All frames at once: a camera ray and a
// ray to the sky are each traced once for the frames in which they meet the same.
//
//   iterations  rays to the sky, a pixel             64; 0: until stopped
//   distance    how far away things can hide the sky 1e6, in scene units
#include <dspm/base/math/sampling.h>
#include <dspm/base/system/parallel.h>
#include <dspm/integrators/camera_numbers.h>
#include <dspm/integrators/integrator.h>
#include <dspm/integrators/tiles.h>
#include <dspm/session/modules/module.h>

namespace {

using namespace dspm;

class Ambient final : public Integrator {
 public:
  Ambient(int iterations, float distance, const Scene& scene, const RenderSettings& render)
      : iterations_(iterations),
        distance_(distance),
        render_(render),
        frames_(static_cast<std::size_t>(scene.frame_count())) {
    open_.resize(static_cast<std::size_t>(render.crop.count()) * frames_);
    statistics_.steps = {{"rays"}};
    statistics_.bytes = open_.size() * sizeof(open_[0]);
  }

  int iterations() const override { return iterations_; }
  std::string settings() const override { return "distance " + std::to_string(distance_); }

  void iterate(const Iteration& iteration) override {
    const StepTimer timer(statistics_.steps[0]);
    parallel_for(render_.crop.height(), 1, [&](std::int64_t row) {
      const int y = render_.crop.y0 + static_cast<int>(row);
      for (int x = render_.crop.x0; x < render_.crop.x1; ++x) look(iteration, x, y);
    });
    ++statistics_.iterations;
  }

  Image estimate(Frame frame, const std::string&) const override {
    Image image(render_.crop.width(), render_.crop.height());
    for (int pixel = 0; pixel < render_.crop.count() && statistics_.iterations > 0; ++pixel)
      image.pixels[static_cast<std::size_t>(pixel)] =
          Rgb(static_cast<float>(open_[slot(pixel, frame)]) / static_cast<float>(statistics_.iterations));
    return image;
  }

  Statistics statistics() const override { return statistics_; }

  bool persist(StateStream& state) override {
    state.value(open_);
    statistics_.persist(state);
    return true;
  }

 private:
  /// One camera ray of the pixel, in all frames.
  void look(const Iteration& iteration, int x, int y) {
    const Scene& scene = iteration.scene;
    const PathRandom random =
        camera_numbers(render_, render_.seed, x, y, static_cast<std::uint64_t>(iteration.number));
    const int pixel = pixel_in_crop(render_.crop, x, y);
    const Vec2 film = film_point(render_, x, y, random);
    scene.camera.for_each(scene.frames(), [&](FrameSet frames, const Camera& camera) {
      const Ray ray = camera.ray(film, random.pair(0, kLightDirection));
      for (const FrameHit& part : scene.accel->partition(ray, frames)) {
        const FrameSet open = part.hit.missed() ? part.frames : open_frames(scene, ray, part, random);
        open.for_each([&](Frame frame) { ++open_[slot(pixel, frame)]; });
      }
    });
  }

  /// Those frames of the part in which a ray from its hit reaches the sky.
  FrameSet open_frames(const Scene& scene, const Ray& ray, const FrameHit& part, const PathRandom& random) const {
    const SurfacePoint point = scene.surface_point(part.hit, ray.direction);
    const Vec3 normal = dot(ray.direction, point.ng) < 0 ? point.ng : -point.ng;
    const Vec3 w = Basis::around(normal).to_world(cosine_hemisphere(random.pair(0, kScatter)));
    return part.frames - scene.accel->occluded(point.spawn(w, distance_), part.frames);
  }

  std::size_t slot(int pixel, Frame frame) const {
    return static_cast<std::size_t>(pixel) * frames_ + static_cast<std::size_t>(frame);
  }

  int iterations_;
  float distance_;
  RenderSettings render_;
  std::size_t frames_;
  std::vector<std::uint32_t> open_;  // rays that reached the sky, by pixel and frame
  Statistics statistics_;
};

std::unique_ptr<Integrator> make_ambient(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  const int iterations = params.integer("iterations", 64, "", "rays to the sky, a pixel; 0: until stopped");
  const float distance = params.number("distance", 1e6f, "scene units", "how far away things can hide the sky");
  if (iterations < 0) params.error("iterations", "the number of iterations must not be negative");
  if (!(distance > 0)) params.error("distance", "the distance must be above 0");
  params.finish();
  return std::make_unique<Ambient>(iterations, distance, scene, render);
}

}  // namespace

DSPM_MODULE(registry) {
  registry.add(integrator_plugins(), {{"ambient", "ambient occlusion: how much of the sky is seen", make_ambient}});
}
