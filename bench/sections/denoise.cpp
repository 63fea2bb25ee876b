// What --denoise makes of images after few iterations: their error and flicker, with and without.
#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/measure/convergence.h"
#include "bench/measure/noise.h"
#include "bench/measure/run.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/looking/flicker.h"
#include "dspm/output/denoised.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr int kIterations = 16, kReferenceSeed = 2000;

struct Example {
  const char* name;
  const char* integrator;
  int first, frames;  // three show flicker
  double share;       // of the width and height
};

constexpr Example kExamples[] = {{"demo", "dsppm", 3, 3, 1},     {"demo", "path", 4, 1, 1},
                                 {"demo", "vcm", 4, 1, 1},       {"horse", "dsppm", 11, 3, 0.5},
                                 {"water", "dsppm", 11, 3, 0.5}, {"product", "dsppm", 1, 1, 0.5}};

Choices choices_of(const Example& example) {
  Choices choices;
  choices.integrator = example.integrator, choices.denoiser = Denoiser::own;
  choices.resolution = Resolution{.share = example.share};
  for (int f = 0; f < example.frames; ++f) choices.frames.push_back(Moment::numbered(example.first + f));
  return choices;
}

/// Two long runs that share no noise, and their mean.
struct References {
  Images a, b, mean;
};

References references_of(const Scene& scene, const Example& example, const Job& job, int iterations) {
  References references{rendered(scene, example.integrator, job, kReferenceSeed, iterations),
                        rendered(scene, example.integrator, job, kReferenceSeed + 1, iterations),
                        {}};
  references.mean = mean_of(references.a, references.b);
  return references;
}

double relative_error(const Images& images, const References& truth) {
  double sum = 0;
  for (std::size_t f = 0; f < images.size(); ++f)
    sum += relative_product(images[f], truth.a[f], truth.b[f], truth.mean[f]);
  return std::sqrt(std::max(0., sum / static_cast<double>(images.size())));
}

/// Through x / (x + half), as eyes and film see it.
double flicker_of(const Images& frames, float half) {
  FlickerMeter meter;
  for (Image shown : frames) {
    for (Rgb& pixel : shown.pixels)
      for (int c = 0; c < 3; ++c) pixel[c] = pixel[c] / (pixel[c] + half);
    meter.add(shown);
  }
  return meter.result().rms;
}

/// What they flicker more than the truth does.
double flicker_of(const Images& images, const References& truth, float half) {
  const double of_truth = flicker_of(truth.mean, half), all = flicker_of(images, half);
  return std::sqrt(std::max(0., all * all - of_truth * of_truth));
}

float half_of_median(const Image& image) {
  std::vector<double> values;
  for (const Rgb& pixel : image.pixels) values.push_back(luminance(pixel));
  return static_cast<float>(median(std::move(values)) / 2);
}

std::vector<std::string> measure_one(const Example& example, int reference_iterations) {
  const LoadedScene loaded = load(our_scene(example.name), choices_of(example));
  const Run run = start(loaded, loaded.job, example.integrator, loaded.job.frames);
  for (int i = 0; i < kIterations; ++i) run.integrator->iterate({i, *run.scene});
  Images plain, filtered;
  for (Frame f = 0; f < run.scene->frame_count(); ++f) {
    plain.push_back(run.integrator->estimate(f));
    filtered.push_back(denoised(Denoiser::own, plain.back(), *run.integrator, f, {}));
  }
  const References truth = references_of(*run.scene, example, loaded.job, reference_iterations);
  const double before = relative_error(plain, truth), after = relative_error(filtered, truth);
  const auto& size = loaded.job.settings.crop;
  std::vector<std::string> cells = {example.name,
                                    example.integrator,
                                    fmt::format("{}, {} x {}", example.frames, size.width(), size.height()),
                                    percent_cell(before),
                                    percent_cell(after),
                                    fmt::format("{:.1f}", before * before / (after * after)),
                                    "",
                                    ""};
  if (plain.size() >= 3) {
    const float half = half_of_median(truth.mean.front());
    cells[6] = fmt::format("{:.2f}%", 100 * flicker_of(plain, truth, half));
    cells[7] = fmt::format("{:.2f}%", 100 * flicker_of(filtered, truth, half));
  }
  return cells;
}

}  // namespace

Findings measure_denoise(const Setup& setup) {
  const int reference_iterations = kIterations * (setup.quick ? 2 : 8);
  Table table(
      {"scene", "integrator", "frames, size", "error, plain", "denoised", "worth", "flicker, plain", "denoised"});
  for (const Example& example : kExamples) {
    if (setup.quick && example.frames > 1) continue;
    say("denoise: {} with {}", example.name, example.integrator);
    try {
      table.row(measure_one(example, reference_iterations));
    } catch (const Skipped& why) {
      table.row({example.name, fmt::format("SKIPPED: {}", why.what()), "", "", "", "", "", ""});
    }
  }
  return {table.text(), {}};
}

}  // namespace dspm
