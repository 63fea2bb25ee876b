// dsppm on all frames of a scene against sppm on each of them, iteration by iteration in turn: the four steps and the
// total as in WG12's table 1, each beside its sharing factor.
//   frames_bench [SCENE] [iterations] [name=value ...]
// Without a scene: the paper's horse in Sibenik, where its models are.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <numeric>

#include "bench/run.h"
#include "core/parallel.h"

namespace {

using namespace dspm;

/// Seconds of each step of one iteration.
std::vector<double> iterate(Run& run, int iteration) {
  const Statistics before = run.integrator->statistics();
  run.integrator->iterate(iteration);
  const Statistics after = run.integrator->statistics();
  std::vector<double> seconds;
  for (std::size_t s = 0; s < after.steps.size(); ++s)
    seconds.push_back(after.steps[s].seconds - before.steps[s].seconds);
  return seconds;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void print_row(const std::string& step, std::vector<double> joint, std::vector<double> alone, double factor) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < joint.size(); ++i) ratios.push_back(alone[i] / joint[i]);
  const double speedup = median(ratios);
  fmt::print("| {} | {:.3f} | {:.3f} | {:.2f} |", step, median(joint), median(alone), speedup);
  if (factor > 0)
    fmt::print(" {:.2f} | {:.0f}% |\n", factor, 100 * speedup / factor);
  else
    fmt::print(" | |\n");
}

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

void compare(const LoadedScene& loaded, const char* estimator, int iterations) {
  const std::vector<Frame>& frames = loaded.job.frames;
  const Job job = with_text(loaded.job, "estimator", estimator);
  Run joint = start(loaded, job, "dsppm", frames);
  std::vector<Run> alone;
  for (const Frame f : frames) alone.push_back(start(loaded, job, "sppm", {f}));

  constexpr std::size_t kSteps = 4;
  std::vector<std::vector<double>> joint_seconds(kSteps + 1), alone_seconds(kSteps + 1);
  for (int i = 0; i < iterations; ++i) {
    const std::vector<double> together = iterate(joint, i);
    std::vector<double> separate(kSteps, 0);
    for (Run& run : alone) {
      const std::vector<double> one = iterate(run, i);
      for (std::size_t s = 0; s < kSteps; ++s) separate[s] += one[s];
    }
    if (i == 0 && iterations > 1) continue;  // buffers grow
    for (std::size_t s = 0; s < kSteps; ++s)
      joint_seconds[s].push_back(together[s]), alone_seconds[s].push_back(separate[s]);
    joint_seconds[kSteps].push_back(sum(together)), alone_seconds[kSteps].push_back(sum(separate));
  }

  const Statistics s = joint.integrator->statistics();
  fmt::print("{} frames, {}, {} iterations, {} threads\n\n", frames.size(), joint.integrator->settings(), iterations,
             thread_count());
  fmt::print(
      "| step | dsppm, s | K x sppm, s | speedup | sharing factor | reached |\n| --- | --- | --- | --- | --- | --- "
      "|\n");
  const double factors[] = {s.camera.segments.factor(), s.photon.segments.factor(), s.photons_stored.factor(),
                            s.photon_tests.factor(), 0};
  for (std::size_t step = 0; step <= kSteps; ++step)
    print_row(step < kSteps ? s.steps[step].name : "all", joint_seconds[step], alone_seconds[step], factors[step]);
  fmt::print("\ndynamic photon paths {:.1f}%, dynamic hit point paths {:.1f}%\n\n", 100 * s.photon.dynamic_share(),
             100 * s.camera.dynamic_share());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    options.scenes = {DSPM_SOURCE_DIR "/bench/sibenik_horse.dsc"};
    options.defines = {"data=" DSPM_TEST_DATA "/data"};
    int iterations = 6;
    if (argc < 2 && !std::filesystem::exists(DSPM_TEST_DATA "/data/sibenik")) {
      fmt::print("SKIPPED: no models in " DSPM_TEST_DATA "/data\n");
      return 0;
    }
    for (int i = 1; i < argc; ++i) {
      const std::string argument = argv[i];
      if (argument.find('=') != std::string::npos)
        options.defines.push_back(argument);
      else if (argument.find_first_not_of("0123456789") == std::string::npos)
        iterations = std::stoi(argument);
      else
        options.scenes = {argument};
    }
    Messages messages(false);
    const LoadedScene loaded(options, messages);
    for (const char* estimator : {"hj09", "kz11"}) compare(loaded, estimator, iterations);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
