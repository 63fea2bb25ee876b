// Seconds an iteration of sppm on the box with glass and the box with a fine mesh, the mean of iterations 17 to 48 as
// other renderers were measured, and the peak memory.
//   sppm_bench [SCENE ...]
#include <fmt/format.h>
#include <sys/resource.h>

#include <filesystem>

#include "app/load.h"
#include "core/parallel.h"

namespace {

using namespace dspm;

constexpr int kFirst = 16, kLast = 48;

void measure(const std::string& path, const char* direct) {
  Options options;
  options.scenes = {path};
  Messages messages(true);
  const LoadedScene loaded(options, messages);
  Job job = loaded.job;
  Param param;
  param.type = ParamType::text, param.name = "direct", param.values = std::vector<std::string>{direct};
  job.params.params.push_back(param);
  const auto scene = loaded.world->scene(job.frames);
  Diagnostics diagnostics;
  const auto integrator = job.make_integrator(*scene, diagnostics);
  diagnostics.throw_if_errors();

  Statistics before;
  for (int i = 0; i < kLast; ++i) {
    if (i == kFirst) before = integrator->statistics();
    integrator->iterate(i);
  }
  const Statistics after = integrator->statistics();
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
