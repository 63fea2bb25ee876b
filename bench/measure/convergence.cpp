#include "bench/measure/convergence.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

/// Renders all frames of a scene: together, or one by one if the integrator renders a frame at a time.
class Renderer {
 public:
  Renderer(const LoadedScene& loaded, const Method& method) {
    const IntegratorPlugin* plugin = integrator_plugins().find(method.integrator);
    const std::vector<FileFrame>& frames = loaded.job.frames;
    if (plugin->frames_together > 1) {
      runs_.push_back(start(loaded, method.job, method.integrator, frames));
    } else {
      runs_ = start_each(loaded, method.job, method.integrator, frames);
    }
  }

  void iterate() {
    for (Run& run : runs_) run.integrator->iterate({iterations_, *run.scene});
    ++iterations_;
  }
  int iterations() const { return iterations_; }
  double seconds() const {
    double sum = 0;
    for (const Run& run : runs_) sum += dspm::seconds(run.integrator->statistics());
    return sum;
  }
  Images images() const {
    Images all;
    for (const Run& run : runs_)
      for (Frame f = 0; f < run.scene->frame_count(); ++f) all.push_back(run.integrator->estimate(f));
    return all;
  }

 private:
  std::vector<Run> runs_;
  int iterations_ = 0;
};

double error_of(const Image& image, const Image& truth) {
  const double floor = error_floor(truth);
  double sum = 0;
  for (std::size_t p = 0; p < image.pixels.size(); ++p) sum += error_of(image.pixels[p], truth.pixels[p], floor);
  return sum / static_cast<double>(image.pixels.size());
}

/// Between a and b on a curve y = c x^e; `at` lies between a.x and b.x.
double power_law(double ax, double ay, double bx, double by, double at) {
  return ay * std::pow(by / ay, std::log(at / ax) / std::log(bx / ax));
}

}  // namespace

double error_of(const Rgb& pixel, const Rgb& truth, double floor) {
  const double a = luminance(pixel), b = luminance(truth);
  return a == b ? 0 : std::min(1., std::abs(a - b) / (b + floor));
}

double error_floor(const Image& truth) {
  double sum = 0;
  for (const Rgb& pixel : truth.pixels) sum += luminance(pixel);
  return 0.01 * sum / static_cast<double>(truth.pixels.size());
}

double error_of(const Images& images, const Images& truth) {
  double sum = 0;
  for (std::size_t f = 0; f < truth.size(); ++f) sum += error_of(images[f], truth[f]);
  return sum / static_cast<double>(truth.size());
}

std::vector<ErrorPoint> converge(const LoadedScene& loaded, const Method& method, const Images& truth, double limit) {
  return converge(
      loaded, method, [&](const Images& images) { return error_of(images, truth); }, limit);
}

std::vector<ErrorPoint> converge(const LoadedScene& loaded, const Method& method,
                                 const std::function<double(const Images&)>& error, double limit) {
  Renderer renderer(loaded, method);
  std::vector<ErrorPoint> curve;
  for (int next = 1; renderer.seconds() < limit;) {
    renderer.iterate();
    if (renderer.iterations() != next && renderer.seconds() < limit) continue;
    curve.push_back({renderer.iterations(), renderer.seconds(), error(renderer.images())});
    next = 2 * renderer.iterations();
  }
  return curve;
}

Images render_for(const LoadedScene& loaded, const Method& method, double limit) {
  Renderer renderer(loaded, method);
  while (renderer.seconds() < limit) renderer.iterate();
  return renderer.images();
}

Images rendered(const Scene& scene, const char* integrator, Job job, int seed, int iterations) {
  job.settings.seed += static_cast<std::uint64_t>(seed);
  const std::unique_ptr<Integrator> made = start(std::move(job), integrator, scene);
  for (int i = 0; i < iterations; ++i) made->iterate({i, scene});
  Images images;
  for (Frame f = 0; f < scene.frame_count(); ++f) images.push_back(made->estimate(f));
  return images;
}

Images long_run(const Scene& scene, const Job& job, int iterations) {
  constexpr int kSeed = 1000;
  const Job faster = with_number(job, "alpha", 0.5f);
  return mean_of(rendered(scene, "dsppm", faster, kSeed, iterations),
                 rendered(scene, "dsppm", faster, kSeed + 1, iterations));
}

Images mean_of(const Images& a, const Images& b) {
  Images mean = a;
  for (std::size_t f = 0; f < a.size(); ++f)
    for (std::size_t p = 0; p < a[f].pixels.size(); ++p) mean[f].pixels[p] = (a[f].pixels[p] + b[f].pixels[p]) * 0.5f;
  return mean;
}

double time_to(std::span<const ErrorPoint> curve, double error) {
  if (curve.front().error <= error) return curve.front().seconds;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const ErrorPoint &a = curve[i - 1], &b = curve[i];
    if (a.error >= error && b.error <= error && a.error > b.error)
      return power_law(a.error, a.seconds, b.error, b.seconds, error);
  }
  return 0;
}

double error_after(std::span<const ErrorPoint> curve, double seconds) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const ErrorPoint &a = curve[i - 1], &b = curve[i];
    if (a.seconds <= seconds && seconds <= b.seconds) return power_law(a.seconds, a.error, b.seconds, b.error, seconds);
  }
  return seconds < curve.front().seconds ? curve.front().error : curve.back().error;
}

}  // namespace dspm
