// Up to 500 fabrics on one chair: the time of one more, and memory.
#include <algorithm>

#include "bench/measure/child.h"
#include "bench/measure/rounds.h"
#include "bench/plots/plots.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/session/frame_intervals.h"

namespace dspm {
namespace {

constexpr double kAskedShare = 0.05;  // of one frame's time, for each additional fabric

struct Measured {
  int fabrics;
  std::size_t intervals, longest;  // the most fabrics that are rendered together
  double over_one;                 // the time of all over that of one
  ChildReport report;

  double additional() const { return (over_one - 1) / (fabrics - 1); }
};

/// Of an interval, over the mean of a few fabrics alone.
double time_over_one(const LoadedScene& loaded, const FrameList& interval, int iterations) {
  std::vector<Group> groups(2);
  groups[0].push_back(start(loaded, loaded.job, "dsppm", interval));
  groups[1] = start_each(loaded, loaded.job, "dsppm", spread_frames(loaded.job.frames, 3));
  const std::vector<Rounds> rounds = in_turns(groups, iterations);
  return ratios(rounds[0], rounds[1]).back();
}

ChildReport render(const LoadedScene& loaded, const std::vector<FileFrame>& fabrics, int iterations) {
  std::vector<std::string> arguments = {loaded.job.scene_file, "--iterations", std::to_string(iterations)};
  for (const FileFrame f : fabrics) arguments.insert(arguments.end(), {"--variation", loaded.job.variation(f)});
  return run_dspm(arguments);
}

Measured measure_one(const LoadedScene& loaded, int count, bool quick) {
  const std::vector<FileFrame> fabrics = spread_frames(loaded.job.frames, static_cast<std::size_t>(count));
  const std::vector<FrameList> intervals = FrameIntervals(*loaded.description, fabrics).cut(kMaxFrames);
  Measured m{static_cast<int>(fabrics.size()), intervals.size(), 0, 0, {}};
  for (const FrameList& interval : intervals) {
    say("{} fabrics: {} together", count, interval.size());
    m.longest = std::max(m.longest, interval.size());
    m.over_one += interval.size() == 1 ? 1 : time_over_one(loaded, interval, quick ? 3 : 5);
  }
  say("{} fabrics: memory", count);
  m.report = render(loaded, fabrics, quick ? 1 : 4);
  return m;
}

std::string table_of(const std::vector<Measured>& all) {
  Table table({"fabrics", "intervals", "together", "time over one's", "each additional one", "peak, MB",
               "pixels, photons, hit points", "trees"});
  for (const Measured& m : all)
    table.row({std::to_string(m.fabrics), std::to_string(m.intervals), std::to_string(m.longest),
               ratio_cell(m.over_one), m.fabrics > 1 ? percent_cell(m.additional()) : "",
               megabytes_cell(m.report.peak_bytes), megabytes_cell(m.report.integrator_bytes),
               megabytes_cell(m.report.tree_bytes)});
  return table.text();
}

PlotFile plot_of(const std::vector<Measured>& all) {
  LinePlot plot{.title = "Peak memory over the number of fabrics", .x_label = "fabrics", .y_label = "MB"};
  LineSeries series{"dsppm", {}};
  for (const Measured& m : all) {
    plot.x_ticks.push_back(m.fabrics);
    series.points.push_back({static_cast<double>(m.fabrics), m.report.peak_bytes / 1e6});
  }
  plot.series.push_back(series);
  return {"fabrics", svg_of(plot)};
}

}  // namespace

Findings measure_fabrics(const Setup& setup) {
  const LoadedScene loaded = load(our_scene("chair-fabrics"));
  std::vector<Measured> all;
  for (const int count : setup.quick ? std::vector<int>{1, 64} : std::vector<int>{1, 64, 128, 500})
    all.push_back(measure_one(loaded, count, setup.quick));
  const Measured& last = all.back();
  return {
      fmt::format("{}\nWith {} fabrics, each additional one takes {} of one frame's time (required: at most {}).\n\n{}",
                  table_of(all), last.fabrics, percent_cell(last.additional()), percent_cell(kAskedShare),
                  plot_link("fabrics", "Peak memory over the number of fabrics")),
      {plot_of(all)}};
}

}  // namespace dspm
