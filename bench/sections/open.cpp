// A sun and a sky over a wide ground, where hardly a photon that starts by the lights' power is found: how many are,
// how soon the picture is as good as it was without learning, and how soon the caustic is there.
#include "bench/measure/reference.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/base/math/frames.h"

namespace dspm {
namespace {

constexpr double kCausticError = 0.1;  // of blocks

Job by_power(const Job& job) { return with_text(with_text(job, "direct", "sampled"), "emission", "power"); }

/// The share of photon paths that leave a photon which a hit point finds, of what pilot paths tell.
double share_found(const LoadedScene& loaded, Job job) {
  job.settings.count_found = job.settings.learn_at_once = true;
  const Run run = start(loaded, job, "dsppm", job.frames);
  const Statistics statistics = run.integrator->statistics();
  for (const EmissionReport& report : statistics.emission)
    if (report.photons == "photons") return report.share_found();
  return 0;
}

std::string seconds_to(std::span<const ErrorPoint> curve, double error) {
  const double time = time_to(curve, error);
  return time > 0 ? fmt::format("{:.2f}", time) : fmt::format("more than {:.0f}", curve.back().seconds);
}

std::string found_table(const LoadedScene& loaded) {
  Table table({"photon paths found", "direct light by rays", "by both"});
  for (const char* emission : {"power", "guided"}) {
    const Job job = with_text(loaded.job, "emission", emission);
    table.row({fmt::format("emission {}", emission),
               fmt::format("{:.4f}%", 100 * share_found(loaded, with_text(job, "direct", "sampled"))),
               fmt::format("{:.4f}%", 100 * share_found(loaded, with_text(job, "direct", "both")))});
  }
  return table.text();
}

/// Iterations of dsppm without learning, and the time and error that they end with.
ErrorPoint without_learning(const LoadedScene& loaded, const Images& truth, int iterations) {
  const Run run = start(loaded, by_power(loaded.job), "dsppm", loaded.job.frames);
  for (int i = 0; i < iterations; ++i) run.integrator->iterate({i, *run.scene});
  Images images;
  for (Frame f = 0; f < run.scene->frame_count(); ++f) images.push_back(run.integrator->estimate(f));
  return {iterations, seconds(run.integrator->statistics()), error_of(images, truth)};
}

std::string time_table(const Comparison& scene, const Reference& reference, double limit, int iterations) {
  say("open: {} iterations without learning", iterations);
  const ErrorPoint before = without_learning(scene.dsppm, reference.truth, iterations);
  const Images blocks = in_blocks(reference.truth);
  const auto caustic = [&](const Images& images) { return error_of(in_blocks(images), blocks, reference.hidden); };
  Table table({fmt::format("seconds to the error of {} iterations by power", iterations), "over theirs",
               fmt::format("seconds to {:.0f}% error of the caustic's blocks", 100 * kCausticError), "method"});
  table.row({fmt::format("{:.2f} (error {:.4f})", before.seconds, before.error), "1", "",
             "dsppm, direct light by rays, emission by power"});
  for (const char* integrator : {"dsppm", "vcm"}) {
    say("open: {}", integrator);
    const LoadedScene& loaded = scene.of(integrator);
    const Method method = {integrator, integrator, loaded.job};
    const std::vector<ErrorPoint> all = converge(loaded, method, reference.truth, limit);
    const std::vector<ErrorPoint> of_caustic = converge(loaded, method, caustic, limit);
    const double time = time_to(all, before.error);
    table.row({seconds_to(all, before.error), time > 0 ? fmt::format("{:.4f}", time / before.seconds) : "",
               seconds_to(of_caustic, kCausticError), integrator});
  }
  return table.text();
}

}  // namespace

Findings measure_open(const Setup& setup) {
  const Comparison scene(foreign("bench/open.dsc"), Choices{});
  std::string text = found_table(scene.dsppm);
  say("open: reference");
  const Reference reference = make_reference(scene, setup.quick ? 12 : 60);
  text += fmt::format(
      "\nThe caustic is {} of the blocks; the reference is uncertain by {:.4f} there and by {:.4f} elsewhere:\n\n",
      percent_cell(reference.hidden.share()), reference.uncertain_hidden, reference.uncertain_seen);
  return {text + time_table(scene, reference, setup.quick ? 6 : 30, setup.quick ? 16 : 256), {}};
}

}  // namespace dspm
