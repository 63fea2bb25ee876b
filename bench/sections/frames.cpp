// Time and memory of up to 256 frames, in intervals of 64.
#include "dspm/base/math/frames.h"

#include <algorithm>

#include "bench/measure/run.h"
#include "bench/plots/plots.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/gallop.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

struct Measured {
  int frames;
  std::vector<double> seconds;  // by round
  double peak_bytes = 0;
};

LinePlot plot_of(const std::vector<Measured>& all, const char* title, const char* label, Scale scale,
                 double (*value)(const Measured&)) {
  LinePlot plot{title, "frames", label, Scale::logarithmic, scale, {}, {{"dsppm, kz11", {}}}};
  for (const Measured& m : all) {
    plot.x_ticks.push_back(m.frames);
    plot.series[0].points.push_back({static_cast<double>(m.frames), value(m)});
  }
  return plot;
}

/// The median over rounds: the time of all frames over that of one interval.
std::string last_ratio(const std::vector<Measured>& all) {
  const Measured& whole = all.back();
  const Measured& part =
      *std::find_if(all.begin(), all.end(), [](const Measured& m) { return m.frames == kMaxFrames; });
  return fmt::format("{} frames take {:.2f} times as long as {}.\n", whole.frames,
                     median_ratio(whole.seconds, part.seconds), part.frames);
}

}  // namespace

Findings measure_frames(const Setup& setup) {
  std::vector<Measured> all;
  for (const int frames : setup.quick ? std::vector<int>{16, 64, 128} : std::vector<int>{8, 16, 32, 64, 128, 256})
    all.push_back({frames, {}});
  const int rounds = setup.quick ? 1 : 3, iterations = setup.quick ? 1 : 4;
  for (int round = 0; round < rounds; ++round) {
    for (Measured& m : all) {
      say("{} frames, round {} of {}", m.frames, round + 1, rounds);
      const ChildReport report = render_gallop(m.frames, "kz11", iterations);
      m.seconds.push_back(report.seconds);
      m.peak_bytes = std::max(m.peak_bytes, report.peak_bytes);
    }
  }
  Table table({"frames", fmt::format("s for {} iterations", iterations), "s per frame", "peak, MB"});
  for (const Measured& m : all)
    table.row({std::to_string(m.frames), fmt::format("{:.2f}", median(m.seconds)),
               fmt::format("{:.4f}", median(m.seconds) / m.frames), megabytes_cell(m.peak_bytes)});
  const LinePlot time = plot_of(all, "Time per frame over the number of frames", "seconds per frame", Scale::linear,
                                [](const Measured& m) { return median(m.seconds) / m.frames; });
  const LinePlot memory = plot_of(all, "Peak memory over the number of frames", "MB", Scale::linear,
                                  [](const Measured& m) { return m.peak_bytes / 1e6; });
  return {table.text() + "\n" + last_ratio(all) + "\n" + plot_link("frames-time", "Time per frame") +
              plot_link("frames-memory", "Peak memory"),
          {{"frames-time", svg_of(time)}, {"frames-memory", svg_of(memory)}}};
}

}  // namespace dspm
