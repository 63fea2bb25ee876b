// The two estimators of dsppm at equal time: the relative error over all frames against a long render, as time goes on,
// and how much longer kz11 takes than hj09 to the same error. Images are small (--quick), as references are long.
//   estimators_bench [SCENE] [iterations of the reference] [name=value ...]
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "bench/run.h"

namespace {

using namespace dspm;

constexpr std::array<const char*, 2> kEstimators = {"hj09", "kz11"};
constexpr int kFirst = 4;  // iterations; then twice as many each time

std::vector<Image> images(const Run& run) {
  std::vector<Image> all;
  for (Frame f = 0; f < run.scene->frame_count(); ++f) all.push_back(run.integrator->estimate(f));
  return all;
}

/// The mean of both estimators, so that neither is favoured; of another seed, so that no noise is shared.
std::vector<Image> reference(const LoadedScene& loaded, int iterations) {
  std::vector<Image> mean;
  for (const char* estimator : kEstimators) {
    Job job = with_text(loaded.job, "estimator", estimator);
    job.settings.seed += 1000;
    const Run run = start(loaded, job, "dsppm", job.frames);
    for (int i = 0; i < iterations; ++i) run.integrator->iterate(i);
    const std::vector<Image> one = images(run);
    if (mean.empty()) mean.assign(one.size(), Image(one[0].width, one[0].height));
    for (std::size_t f = 0; f < one.size(); ++f)
      for (std::size_t p = 0; p < one[f].pixels.size(); ++p)
        mean[f].pixels[p] += one[f].pixels[p] / static_cast<float>(kEstimators.size());
  }
  return mean;
}

/// The mean of |a - b| / (b + 0.01) over pixels: a lamp that few pixels see in glass weighs no more than they are.
double error(const Image& image, const Image& truth) {
  double sum = 0;
  for (std::size_t p = 0; p < image.pixels.size(); ++p) {
    const float b = luminance(truth.pixels[p]);
    sum += std::abs(luminance(image.pixels[p]) - b) / (b + 0.01f);
  }
  return sum / static_cast<double>(image.pixels.size());
}

struct Point {
  int iterations;
  double seconds, error;
};

std::vector<Point> converge(const LoadedScene& loaded, const char* estimator, const std::vector<Image>& truth,
                            int iterations) {
  const Run run = start(loaded, with_text(loaded.job, "estimator", estimator), "dsppm", loaded.job.frames);
  std::vector<Point> points;
  for (int i = 0, next = kFirst; i < iterations; ++i) {
    run.integrator->iterate(i);
    if (i + 1 != next) continue;
    next *= 2;
    double sum = 0;
    const std::vector<Image> now = images(run);
    for (std::size_t f = 0; f < truth.size(); ++f) sum += error(now[f], truth[f]);
    points.push_back({i + 1, seconds(run.integrator->statistics()), sum / static_cast<double>(truth.size())});
  }
  return points;
}

/// When `curve` reaches `error`: a power law between its points; 0 where it does not.
double time_to(const std::vector<Point>& curve, double error) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const Point &a = curve[i - 1], &b = curve[i];
    if (a.error < error || b.error > error) continue;
    const double t = std::log(error / a.error) / std::log(b.error / a.error);
    return a.seconds * std::pow(b.seconds / a.seconds, t);
  }
  return 0;
}

void compare(const LoadedScene& loaded, int reference_iterations) {
  const std::vector<Image> truth = reference(loaded, reference_iterations);
  const int most = reference_iterations / 4;
  const auto hj09 = converge(loaded, "hj09", truth, most), kz11 = converge(loaded, "kz11", truth, 2 * most);
  fmt::print(
      "{}, {} frames, reference {} iterations of each\n\n"
      "| iterations | hj09, s | error | kz11, s | error | time to hj09's error, kz11 / hj09 |\n"
      "| --- | --- | --- | --- | --- | --- |\n",
      loaded.job.scene_file, truth.size(), reference_iterations);
  for (std::size_t i = 0; i < hj09.size(); ++i) {
    const double time = time_to(kz11, hj09[i].error);
    fmt::print("| {} | {:.2f} | {:.4f} | {:.2f} | {:.4f} | {} |\n", hj09[i].iterations, hj09[i].seconds, hj09[i].error,
               kz11[i].seconds, kz11[i].error, time > 0 ? fmt::format("{:.2f}", time / hj09[i].seconds) : "-");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    options.scenes = {argc > 1 ? argv[1] : DSPM_SOURCE_DIR "/scenes/demo.dsc"};
    for (int i = 3; i < argc; ++i) options.defines.emplace_back(argv[i]);
    options.quick = true;
    options.photons = 20000;
    Messages messages(true);
    const LoadedScene loaded(options, messages);
    compare(loaded, argc > 2 ? std::stoi(argv[2]) : 1024);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
