#include "dspm/session/plan_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/memory_use.h"
#include "dspm/base/system/readable.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/part.h"
#include "dspm/session/stage.h"

namespace dspm {
namespace {

using Clock = std::chrono::steady_clock;

/// A way to share out: machines for the frames times machines for the iterations.
struct Way {
  int frames, iterations;
  double seconds = 0;     // of each machine
  std::size_t bytes = 0;  // likewise

  std::string option() const {
    if (frames * iterations == 1) return "(one machine)";
    const std::string of_iterations = iterations > 1 ? fmt::format("1/{}", iterations) : "";
    if (frames == 1) return of_iterations;
    return fmt::format("frames:1/{}{}{}", frames, iterations > 1 ? "," : "", of_iterations);
  }
};

template <class Work>
double seconds_of(Work&& work) {
  const Clock::time_point begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Tries the way's largest part; `loading` is the time until the scene is loaded, in seconds. Returns false if there
/// are too few frames or iterations.
bool try_out(Way& way, const LoadedScene& loaded, double loading, Messages& messages) {
  const FrameIntervals frames(*loaded.description, loaded.job.frames);
  std::vector<FrameList> parts = frames.deal(way.frames);
  if (parts.size() < static_cast<std::size_t>(way.frames)) return false;
  const FrameList largest = *std::max_element(
      parts.begin(), parts.end(), [](const FrameList& a, const FrameList& b) { return a.size() < b.size(); });
  const std::vector<FrameList> intervals =
      FrameIntervals(*loaded.description, largest).cut(loaded.job.plugin->frames_together);
  std::optional<Stage> stage;
  const double making = seconds_of([&] { stage.emplace(loaded, intervals.front()).make_integrator(messages); });
  const int all = loaded.job.iterations(stage->integrator());
  if (all == 0) throw UsageError("--plan: of how many iterations? Give --iterations");
  if (all < way.iterations) return false;
  const int share = Part{1, way.iterations}.share_of(all);
  const double first = seconds_of([&] { stage->iterate(0); });
  const double usual = seconds_of([&] { stage->iterate(1); });
  const double learning = std::max(0.0, first - usual);  // later intervals take it over
  way.seconds = loading + learning + static_cast<double>(intervals.size()) * (making + share * usual);
  way.bytes = peak_memory();
  return true;
}

}  // namespace

std::string plan_parts(const LoadedScene& loaded, double loading, int machines, Messages& messages) {
  std::vector<Way> ways;
  const auto consider = [&](Way way) {
    if (try_out(way, loaded, loading, messages)) ways.push_back(way);
    loaded.job.settings.file->forget();
  };
  for (int frames = machines; frames >= 1; --frames)  // the process's peak of memory only grows
    if (machines % frames == 0) consider({frames, machines / frames});
  if (ways.empty())
    throw UsageError(fmt::format("--plan {}: neither frames nor iterations make so many parts", machines));
  consider({1, 1});
  const auto best =
      std::min_element(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.seconds < b.seconds; });
  std::string text = fmt::format("{:<24} {:>12} {:>12}\n", "--part", "time", "memory");
  for (auto way = ways.begin(); way != ways.end(); ++way)
    text += fmt::format("{:<24} {:>12} {:>12}{}\n", way->option(), readable_time(way->seconds),
                        readable_bytes(way->bytes), way == best ? "  fastest" : "");
  return text;
}

}  // namespace dspm
