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

namespace dspm {
namespace {

constexpr int kPhotons = 300000 / 16;  // for a quarter of the width and height

struct Product {
  std::filesystem::path file;
  double time = 0, noise = 0;  // at most, as was asked; 0: nothing was asked
};

std::vector<Product> products(const Setup& setup) {
  if (!setup.scene.empty()) return {{setup.scene}};
  return {{our_scene("chair-finishes"), 3, 1.1}, {our_scene("chair-gloss"), 6, 1.3}};
}

/// All of dsppm over sppm at equal iterations, by variation, ascending.
struct Noise {
  int iterations;
  std::vector<double> deviations;  // standard deviations
  std::vector<double> errors;      // root mean square distances to the reference
};

struct NoiseSettings {
  int iterations, seeds, reference;
  std::size_t variations;  // at most so many are compared
};

Images rendered(const LoadedScene& loaded, const char* integrator, Job job, int seed, int iterations) {
  job.settings.seed += static_cast<std::uint64_t>(seed);
  return render(loaded, {integrator, integrator, std::move(job)}, iterations);
}

/// Of other seeds than what is compared, and with radii that shrink faster.
Images reference(const LoadedScene& loaded, const Job& job, int iterations) {
  const Job faster = with_number(job, "alpha", 0.5f);
  return mean_of(rendered(loaded, "dsppm", faster, 1000, iterations),
                 rendered(loaded, "dsppm", faster, 1001, iterations));
}

/// Of one variation by one integrator: sums over seeds.
struct Squares {
  double error = 0, variance = 0;
};

Squares squares(const std::vector<Images>& by_seed, std::size_t i, const Image& truth) {
  Squares sum;
  for (std::size_t s = 0; s < by_seed.size(); ++s) {
    sum.error += relative_square(by_seed[s][i], truth, truth);
    if (s > 0) sum.variance += relative_square(by_seed[s][i], by_seed[s - 1][i], truth);
  }
  return sum;
}

Noise measure_noise(const LoadedScene& loaded, const NoiseSettings& settings) {
  const Job all = with_integer(loaded.job, "photons", kPhotons);
  Job some = all;
  some.frames = spread_frames(all.frames, settings.variations);
  say("noise: reference");
  const Images truth = reference(loaded, all, settings.reference);
  std::vector<Images> together, alone;
  for (int seed = 0; seed < settings.seeds; ++seed) {
    say("noise: seed {} of {}", seed + 1, settings.seeds);
    together.push_back(rendered(loaded, "dsppm", all, seed, settings.iterations));
    alone.push_back(rendered(loaded, "sppm", some, seed, settings.iterations));
  }
  Noise noise{settings.iterations, {}, {}};
  for (std::size_t i = 0; i < some.frames.size(); ++i) {
    const auto found = std::find(all.frames.begin(), all.frames.end(), some.frames[i]);
    const auto among_all = static_cast<std::size_t>(found - all.frames.begin());
    const Squares joint = squares(together, among_all, truth[among_all]);
    const Squares own = squares(alone, i, truth[among_all]);
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
  Options options;
  options.defines = setup.defines;
  const std::string name = product.file.stem().string();
  say("{}: time", name);
  const LoadedScene loaded = load(product.file, options);
  const Share share = measure_share(loaded, loaded.job.frames, setup.quick ? 3 : 5, setup.quick ? 4 : 12);
  options.quick = true;
  const NoiseSettings settings = setup.quick
                                     ? NoiseSettings{8, 2, 32, 6}
                                     : NoiseSettings{.iterations = 16, .seeds = 4, .reference = 256, .variations = 64};
  return {name, product, share, measure_noise(load(product.file, options), settings)};
}

std::string totals(const std::vector<Measured>& all) {
  Table table({"scene", "variations", "time over one frame's, dsppm", "sppm", "asked",
               "standard deviation over sppm's: worst", "median", "error over sppm's: worst", "median", "asked"});
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
