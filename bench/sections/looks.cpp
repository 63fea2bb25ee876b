// Variations of a product that differ in looks: the time of all of them over that of one, and whether they are noisier
// together than each is alone.
#include <algorithm>
#include <array>
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

/// An image of each of the scene's frames.
Images rendered(const Scene& scene, const char* name, Job job, int seed, int iterations) {
  job.settings.seed += static_cast<std::uint64_t>(seed);
  const std::unique_ptr<Integrator> integrator = start(std::move(job), name, scene);
  for (int i = 0; i < iterations; ++i) integrator->iterate(i);
  Images images;
  for (Frame f = 0; f < scene.frame_count(); ++f) images.push_back(integrator->estimate(f));
  return images;
}

/// By seed.
std::vector<Images> rendered_by_seed(const Scene& scene, const char* name, const Job& job,
                                     const NoiseSettings& settings) {
  std::vector<Images> all;
  for (int seed = 0; seed < settings.seeds; ++seed)
    all.push_back(rendered(scene, name, job, seed, settings.iterations));
  return all;
}

/// Of other seeds than what is compared, and with radii that shrink faster.
Images reference(const Scene& scene, const Job& job, int iterations) {
  const Job faster = with_number(job, "alpha", 0.5f);
  return mean_of(rendered(scene, "dsppm", faster, 1000, iterations),
                 rendered(scene, "dsppm", faster, 1001, iterations));
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

Noise measure_noise(const LoadedScene& loaded, const NoiseSettings& settings) {
  const Job job = with_integer(loaded.job, "photons", kPhotons);
  const std::vector<Frame>& frames = job.frames;
  const std::unique_ptr<Scene> scene = loaded.world->scene(frames);
  say("noise: reference");
  const Images truth = reference(*scene, job, settings.reference);
  say("noise: all together");
  const std::vector<Images> together = rendered_by_seed(*scene, "dsppm", job, settings);
  Noise noise{settings.iterations, {}, {}};
  for (const Frame f : spread_frames(frames, settings.variations)) {
    say("noise: frame {}", f + 1);
    const std::vector<Images> alone = rendered_by_seed(*loaded.world->scene(std::array{f}), "sppm", job, settings);
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
  Options options;
  options.defines = setup.defines;
  const std::string name = product.file.stem().string();
  say("{}: time", name);
  const LoadedScene loaded = load(product.file, options);
  const Share share = measure_share(loaded, loaded.job.frames, setup.quick ? 2 : 5, setup.quick ? 3 : 12);
  options.quick = true;
  const NoiseSettings settings = setup.quick
                                     ? NoiseSettings{8, 4, 32, 4}
                                     : NoiseSettings{.iterations = 16, .seeds = 8, .reference = 256, .variations = 64};
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
