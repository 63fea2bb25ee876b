// Spectral renders against those in RGB: what an iteration costs, how noisy images are, how far colours are from where they
// will be, and how far RGB is from them.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "bench/measure/noise.h"
#include "bench/measure/run.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/smooth_spectra.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/image/image.h"
#include "dspm/session/exposure.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

/// The squares of the differences of colours from where they converge to, and the largest of any component.
struct Differences {
  double squares = 0, largest = 0;
  int count = 0;

  void add(const Rgb& found, const Rgb& converged) {
    for (int c = 0; c < 3; ++c) {
      const double difference = std::abs(double{found[c]} - double{converged[c]});
      squares += difference * difference, largest = std::max(largest, difference), ++count;
    }
  }
  std::string text() const { return fmt::format("{:.2f}%, {:.1f}%", 100 * std::sqrt(squares / count), 100 * largest); }
};

struct Patch {
  Rgb colour, converged;
};

/// 64 patches with components of 1/8 to 7/8.
std::vector<Patch> chart() {
  std::vector<Patch> patches;
  for (const int r : {2, 6, 10, 14})
    for (const int g : {2, 6, 10, 14})
      for (const int b : {2, 6, 10, 14}) {
        const SmoothSpectrum& spectrum = SmoothSpectra::all().at(r, g, b);
        std::array<double, 3> sum{};
        for (int nm = kFirstNm; nm <= kLastNm; ++nm)
          for (std::size_t c = 0; c < 3; ++c) sum[c] += part_of_white(nm)[c] * double{spectrum.at(nm)};
        patches.push_back({Rgb(static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)) / 16,
                           {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])}});
      }
  return patches;
}

std::string chart_table() {
  constexpr std::uint64_t kSeeds = 50;
  const std::vector<Patch> patches = chart();
  std::vector<std::string> head{"iterations"}, white{"white"}, colours{"64 diffuse patches"};
  for (const int iterations : {1, 2, 4, 8, 16, 64, 256}) {
    Differences of_white, of_patches;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      std::vector<Rgb> sums(patches.size());
      Rgb white_sum;
      for (int i = 0; i < iterations; ++i) {
        const auto palette = Palette::of_iteration(seed, static_cast<std::uint64_t>(i));
        white_sum += palette->seen(Spectrum(1));
        for (std::size_t p = 0; p < patches.size(); ++p) sums[p] += palette->seen(palette->carried(patches[p].colour));
      }
      of_white.add(white_sum / static_cast<float>(iterations), Rgb(1));
      for (std::size_t p = 0; p < patches.size(); ++p)
        of_patches.add(sums[p] / static_cast<float>(iterations), patches[p].converged);
    }
    head.push_back(std::to_string(iterations)), white.push_back(of_white.text()), colours.push_back(of_patches.text());
  }
  Table table(head);
  table.row(white), table.row(colours);
  return table.text();
}

/// A render that goes on iteration by iteration.
class Going {
 public:
  Going(const std::filesystem::path& scene, const char* integrator, const char* colour, std::uint64_t seed)
      : loaded_(load(scene, choices(integrator, colour, seed))),
        scene_(loaded_.world->scene({loaded_.job.frames.data(), 1})),
        exposure_(loaded_.job, *loaded_.world, *scene_),
        integrator_(start(loaded_.job, integrator, *scene_)) {}

  double iterate(int number) {
    const auto begin = std::chrono::steady_clock::now();
    integrator_->iterate(exposure_.iteration(number));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  Image image() const { return integrator_->estimate(0); }

 private:
  static Choices choices(const char* integrator, const char* colour, std::uint64_t seed) {
    Choices choices;
    choices.integrator = integrator, choices.colour = colour, choices.seed = seed;
    choices.resolution = Resolution{.width = 192, .height = 108};
    return choices;
  }

  LoadedScene loaded_;
  std::unique_ptr<Scene> scene_;
  Exposure exposure_;
  std::unique_ptr<Integrator> integrator_;
};

constexpr std::array kNoiseAfter{4, 16, 64};

/// The noise of images at those numbers of iterations, and the seconds of each of these.
struct OfColour {
  std::vector<double> noise, seconds;
  Image last;
};

/// Two renders of each kind that differ in their seeds, and take turns.
std::array<OfColour, 2> measure(const std::filesystem::path& scene, const char* integrator) {
  std::array<OfColour, 2> all;
  std::array<std::array<std::unique_ptr<Going>, 2>, 2> runs;
  for (std::size_t kind = 0; kind < 2; ++kind)
    for (std::uint64_t seed = 0; seed < 2; ++seed)
      runs[kind][seed] = std::make_unique<Going>(scene, integrator, kind == 0 ? "rgb" : "spectral", seed + 1);
  for (int i = 0; i < kNoiseAfter.back(); ++i) {
    for (std::size_t kind = 0; kind < 2; ++kind)
      for (const auto& run : runs[kind]) {
        const double seconds = run->iterate(i);
        if (i > 0) all[kind].seconds.push_back(seconds);
      }
    if (std::find(kNoiseAfter.begin(), kNoiseAfter.end(), i + 1) == kNoiseAfter.end()) continue;
    const Image truth = runs[0][0]->image();
    for (std::size_t kind = 0; kind < 2; ++kind)
      all[kind].noise.push_back(std::sqrt(relative_square(runs[kind][0]->image(), runs[kind][1]->image(), truth) / 2));
  }
  return all;
}

std::string scenes_table(bool quick) {
  std::vector<std::string> head{"scene", "integrator", "seconds of an iteration"};
  for (const int iterations : kNoiseAfter) head.push_back(fmt::format("noise after {}", iterations));
  Table table(head);
  std::vector<std::pair<std::string, std::filesystem::path>> scenes;
  for (const char* name : {"demo", "material", "lamp", "fog", "product"}) scenes.emplace_back(name, our_scene(name));
  for (const char* name : {"cornell-box", "veach-mis", "staircase2"})
    scenes.emplace_back(name, foreign(fmt::format("data/pbrt/{}/scene-v4.pbrt", name)));
  if (quick) scenes.resize(1);
  for (const auto& [name, file] : scenes)
    for (const char* integrator : {"path", "dsppm"}) {
      say("{}: {}", name, integrator);
      try {
        const auto [rgb, spectral] = measure(file, integrator);
        std::vector<std::string> row{name, integrator, ratio_cell(median_ratio(spectral.seconds, rgb.seconds))};
        for (std::size_t i = 0; i < rgb.noise.size(); ++i)
          row.push_back(fmt::format("{:.3f}, {}", spectral.noise[i], ratio_cell(spectral.noise[i] / rgb.noise[i])));
        table.row(row);
      } catch (const Skipped& why) {
        table.row({name, integrator, fmt::format("SKIPPED: {}", why.what())});
      }
    }
  return table.text();
}

}  // namespace

Findings measure_colours(const Setup& setup) {
  return {"Differences from the converged colour, of any component: root mean square, largest of 50 seeds.\n\n" +
              chart_table() +
              "\nOver RGB, in turns; noise is that between two seeds, and its factor over that of RGB:\n\n" +
              scenes_table(setup.quick),
          {}};
}

}  // namespace dspm
