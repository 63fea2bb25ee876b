// Variations of a product that differ in looks: the time of all of them over that of one, and whether they are noisier
// together than each is alone.
#include <algorithm>
#include <cmath>

#include "bench/measure/convergence.h"
#include "bench/measure/noise.h"
#include "bench/measure/share.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr int kPhotons = 300000 / 16;  // for a quarter of the width and height
constexpr int kOwnSeed = 500;          // a frame in a file of its own shares no seed with the joint run

struct Product {
  std::filesystem::path file;
  double time = 0, noise = 0;  // at most, as required; 0: not required
};

std::vector<Product> products(const Setup& setup) {
  if (!setup.scene.empty()) return {{setup.scene}};
  return {{our_scene("chair-finishes"), 3, 1.1}, {our_scene("chair-gloss"), 6, 1.3}};
}

/// dsppm over sppm in files of their own, at equal iterations, by variation, ascending.
struct Noise {
  int iterations;
  std::vector<double> deviations;  // standard deviations
  std::vector<double> errors;      // root mean square distances to the reference
};

struct NoiseSettings {
  int iterations, seeds, reference;
  std::size_t variations;  // at most this many are compared
};

/// By seed.
std::vector<Images> rendered_by_seed(const Scene& scene, const char* name, const Job& job, int first_seed,
                                     const NoiseSettings& settings) {
  std::vector<Images> all;
  for (int seed = first_seed; seed < first_seed + settings.seeds; ++seed)
    all.push_back(rendered(scene, name, job, seed, settings.iterations));
  return all;
}

/// Of a frame: sums over seeds.
struct Squares {
  double error = 0, variance = 0;
};

Squares squares(const std::vector<Images>& by_seed, std::size_t frame, const Image& truth) {
  Squares sum;
  for (std::size_t s = 0; s < by_seed.size(); ++s) {
    sum.error += relative_square(by_seed[s][frame], truth, truth);
    if (s > 0) sum.variance += relative_square(by_seed[s][frame], by_seed[s - 1][frame], truth);
  }
  return sum;
}

/// Each variation among all others against that by sppm in a file of its own.
Noise measure_noise(const Product& product, const Choices& choices, const NoiseSettings& settings) {
  const LoadedScene loaded = load(product.file, choices);
  const Job job = with_integer(loaded.job, "photons", kPhotons);
  const std::vector<FileFrame>& frames = job.frames;
  const std::unique_ptr<Scene> scene = loaded.world->scene(frames);
  say("noise: reference");
  const Images truth = long_run(*scene, job, settings.reference);
  say("noise: all together");
  const std::vector<Images> together = rendered_by_seed(*scene, "dsppm", job, 0, settings);
  Noise noise{settings.iterations, {}, {}};
  for (const FileFrame f : spread_frames(frames, settings.variations)) {
    say("noise: frame {}", f.index() + 1);
    const LoadedScene file = load(product.file, choices, f);
    const Job own_job = with_integer(file.job, "photons", kPhotons);
    const std::vector<Images> alone =
        rendered_by_seed(*file.world->scene(file.job.frames), "sppm", own_job, kOwnSeed, settings);
    const auto i = static_cast<std::size_t>(std::find(frames.begin(), frames.end(), f) - frames.begin());
    const Squares joint = squares(together, i, truth[i]), own = squares(alone, 0, truth[i]);
    noise.deviations.push_back(std::sqrt(joint.variance / own.variance));
    noise.errors.push_back(std::sqrt(joint.error / own.error));
  }
  std::sort(noise.deviations.begin(), noise.deviations.end());
  std::sort(noise.errors.begin(), noise.errors.end());
  return noise;
}

struct Measured {
  std::string name;
  Product product;
  Share share;
  Noise noise;
};

Measured measure_one(const Product& product, const Setup& setup) {
  Choices choices;
  choices.defines = setup.defines;
  const std::string name = product.file.stem().string();
  say("{}: time", name);
  const LoadedScene loaded = load(product.file, choices);
  const Share share = measure_share(loaded, loaded.job.frames, setup.quick ? 2 : 5, setup.quick ? 3 : 12);
  choices.quick = true;
  const NoiseSettings settings = setup.quick
                                     ? NoiseSettings{8, 4, 32, 4}
                                     : NoiseSettings{.iterations = 16, .seeds = 8, .reference = 256, .variations = 8};
  return {name, product, share, measure_noise(product, choices, settings)};
}

std::string totals(const std::vector<Measured>& all) {
  Table table({"scene", "variations", "time over one frame's, dsppm", "sppm", "required",
               "standard deviation over that in a file of its own: worst", "median", "error likewise: worst", "median",
               "required"});
  for (const Measured& m : all)
    table.row({m.name, std::to_string(m.share.frames), ratio_cell(m.share.over_dsppm.back()),
               ratio_cell(m.share.over_sppm.back()), ratio_cell(m.product.time), ratio_cell(m.noise.deviations.back()),
               ratio_cell(median(m.noise.deviations)), ratio_cell(m.noise.errors.back()),
               ratio_cell(median(m.noise.errors)), ratio_cell(m.product.noise)});
  return table.text();
}

std::string details(const Measured& m) {
  return fmt::format(
      "\n{}: {} of the photon paths and {} of the camera paths meet something that differs. Noise: {} variations, {} "
      "iterations.\n\n{}",
      m.name, percent_cell(m.share.dynamic_photons), percent_cell(m.share.dynamic_hit_points),
      m.noise.deviations.size(), m.noise.iterations, table_of(m.share));
}

}  // namespace

Findings measure_looks(const Setup& setup) {
  std::vector<Measured> all;
  std::string text;
  for (const Product& product : products(setup)) {
    try {
      all.push_back(measure_one(product, setup));
      text += details(all.back());
    } catch (const Skipped& why) {
      text += fmt::format("\n{}: SKIPPED, {}\n", product.file.stem().string(), why.what());
    }
  }
  return {(all.empty() ? "" : totals(all)) + text, {}};
}

}  // namespace dspm
