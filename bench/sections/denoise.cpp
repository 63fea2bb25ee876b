// What --denoise makes of images after few iterations: their error and flicker, with and without.
#include <algorithm>
#include <array>
#include <cmath>

#include "bench/measure/convergence.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/looking/flicker.h"
#include "dspm/math/frames.h"
#include "dspm/output/denoised.h"
#include "dspm/scene/scene.h"

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

/// Two independent ones: the product of the distances from both is free of their own noise.
using References = std::array<Images, 2>;

double relative_error(const Images& images, const References& truth) {
  double sum = 0, count = 0;
  for (std::size_t f = 0; f < images.size(); ++f) {
    const Image &a = truth[0][f], &b = truth[1][f];
    const double floor = error_floor(a);
    for (std::size_t p = 0; p < a.pixels.size(); ++p) {
      const Rgb from_a = images[f].pixels[p] - a.pixels[p], from_b = images[f].pixels[p] - b.pixels[p];
      const double scale = 0.5 * (luminance(a.pixels[p]) + luminance(b.pixels[p])) + floor;
      for (int c = 0; c < 3; ++c, ++count)
        sum += std::clamp(static_cast<double>(from_a[c]) * from_b[c] / (scale * scale), -1., 1.);
    }
  }
  return std::sqrt(std::max(0., sum / count));
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
  const double of_truth = flicker_of(mean_of(truth[0], truth[1]), half), all = flicker_of(images, half);
  return std::sqrt(std::max(0., all * all - of_truth * of_truth));
}

float half_of_median(const Image& image) {
  std::vector<float> values;
  for (const Rgb& pixel : image.pixels) values.push_back(luminance(pixel));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return 0.5f * *middle;
}

std::vector<std::string> measure_one(const Example& example, int reference_iterations) {
  const LoadedScene loaded = load(our_scene(example.name), choices_of(example));
  const Run run = start(loaded, loaded.job, example.integrator, loaded.job.frames);
  for (int i = 0; i < kIterations; ++i) run.integrator->iterate(i, *run.scene);
  Images plain, filtered;
  for (Frame f = 0; f < run.scene->frame_count(); ++f) {
    plain.push_back(run.integrator->estimate(f));
    filtered.push_back(denoised(Denoiser::own, plain.back(), *run.integrator, f, {}));
  }
  References truth;
  for (std::size_t r = 0; r < truth.size(); ++r)
    truth[r] = rendered(*run.scene, example.integrator, loaded.job, kReferenceSeed + static_cast<int>(r),
                        reference_iterations);
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
    const float half = half_of_median(truth[0].front());
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
