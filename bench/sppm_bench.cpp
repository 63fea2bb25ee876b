// Seconds an iteration of sppm on the box with glass and the box with a fine mesh, the mean of iterations 17 to 48 as
// other renderers were measured, and the peak memory.
//   sppm_bench [SCENE ...]
#include <fmt/format.h>
#include <sys/resource.h>

#include <filesystem>

#include "bench/run.h"
#include "core/parallel.h"

namespace {

using namespace dspm;

constexpr int kFirst = 16, kLast = 48;

void measure(const std::string& path, const char* direct) {
  Options options;
  options.scenes = {path};
  Messages messages(true);
  const LoadedScene loaded(options, messages);
  const Run run = start(loaded, with_text(loaded.job, "direct", direct), "sppm", loaded.job.frames);

  Statistics before;
  for (int i = 0; i < kLast; ++i) {
    if (i == kFirst) before = run.integrator->statistics();
    run.integrator->iterate(i);
  }
  const Statistics after = run.integrator->statistics();
  double all = 0;
  std::string steps;
  for (std::size_t s = 0; s < after.steps.size(); ++s) {
    const double seconds = (after.steps[s].seconds - before.steps[s].seconds) / (kLast - kFirst);
    all += seconds;
    steps += fmt::format(" {:.3f} |", seconds);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("| {} | {} | {:.3f} |{} {:.2f} M | {} MiB |\n", std::filesystem::path(path).stem().string(), direct, all,
             steps,
             static_cast<double>(after.camera.segments.done + after.photon.segments.done + after.camera.shadow_rays) /
                 1e6 / kLast,
             usage.ru_maxrss / 1024);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> scenes(argv + 1, argv + argc);
  if (scenes.empty()) scenes = {DSPM_TEST_DATA "/bench/glassball.pbrt", DSPM_TEST_DATA "/bench/blob.pbrt"};
  fmt::print(
      "seconds an iteration, mean of iterations {} to {}, {} threads; memory is the process's peak so far\n\n"
      "| scene | direct light | all | hit points | photons | photon map | statistics | rays | memory |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      kFirst + 1, kLast, thread_count());
  for (const std::string& scene : scenes) {
    if (!std::filesystem::exists(scene)) {
      fmt::print("SKIPPED: there is no {}\n", scene);
      continue;
    }
    try {
      for (const char* direct : {"photons", "sampled"}) measure(scene, direct);
    } catch (const std::exception& e) {
      fmt::print(stderr, "{}\n", e.what());
      return 1;
    }
  }
}
