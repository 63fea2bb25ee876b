// WG12's table 2: peak memory over the number of frames, and its growth.
#include "bench/measure/child.h"
#include "bench/measure/run.h"
#include "bench/plots/plots.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/report/wg12.h"
#include "bench/sections/gallop.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

constexpr double kPaperGrowth = 25;  // MB per frame from 8 to 32: (874 - 282) / 24

struct Measured {
  int frames;
  ChildReport report;
};

/// Everything that is neither the integrator's nor the trees': meshes, the program, images being written.
double rest(const ChildReport& r) { return r.peak_bytes - r.tree_bytes - r.integrator_bytes; }

std::string paper_cell(int frames) {
  for (const wg12::HorseRow& row : wg12::kHorse)
    if (row.frames == frames) return fmt::format("{:.0f}", row.megabytes);
  return frames == 1 ? fmt::format("{:.0f}", wg12::kSppmMegabytes) : "";
}

std::string table_of(const std::vector<Measured>& all) {
  Table table({"K", "peak, MB", "WG12", "pixels, photons, hit points", "trees", "meshes and all else"});
  for (const Measured& m : all)
    table.row({std::to_string(m.frames), megabytes_cell(m.report.peak_bytes), paper_cell(m.frames),
               megabytes_cell(m.report.integrator_bytes), megabytes_cell(m.report.tree_bytes),
               megabytes_cell(rest(m.report))});
  return table.text();
}

/// From 8 frames on, because up to there some buffers do not grow.
std::string growth(const std::vector<Measured>& all) {
  const Measured &first = all[1], &last = all.back();
  const auto a_frame = [&](double from, double to) { return (to - from) / 1e6 / (last.frames - first.frames); };
  const ChildReport &a = first.report, &b = last.report;
  return fmt::format(
      "From {} to {} frames the peak grows by {:.1f} MB per frame (WG12: {:.0f}): pixels, photons and hit points by "
      "{:.1f}, "
      "trees by {:.1f}, meshes and all else by {:.1f}.\n",
      first.frames, last.frames, a_frame(a.peak_bytes, b.peak_bytes), kPaperGrowth,
      a_frame(a.integrator_bytes, b.integrator_bytes), a_frame(a.tree_bytes, b.tree_bytes), a_frame(rest(a), rest(b)));
}

LineSeries series_of(const char* name, const std::vector<Measured>& all) {
  LineSeries series{name, {}};
  for (const Measured& m : all) series.points.push_back({static_cast<double>(m.frames), m.report.peak_bytes / 1e6});
  return series;
}

}  // namespace

Findings measure_memory(const Setup& setup) {
  const std::vector<int> counts = setup.quick ? std::vector<int>{1, 8, 32} : std::vector<int>{1, 8, 16, 24, 32, 64};
  LinePlot plot{.title = "Peak memory of K frames together", .x_label = "frames", .y_label = "MB"};
  plot.x_ticks.assign(counts.begin(), counts.end());
  std::string text;
  for (const char* estimator : {"kz11", "hj09"}) {
    std::vector<Measured> all;
    for (const int frames : counts) {
      say("{} frames, {}", frames, estimator);
      all.push_back({frames, render_gallop(frames, estimator, setup.quick ? 2 : 6)});
    }
    text += fmt::format("\n{}:\n\n{}\n{}", estimator, table_of(all), growth(all));
    plot.series.push_back(series_of(estimator, all));
  }
  LineSeries paper{"WG12", {{1, wg12::kSppmMegabytes}}, true};
  for (const wg12::HorseRow& row : wg12::kHorse)
    paper.points.push_back({static_cast<double>(row.frames), row.megabytes});
  plot.series.push_back(paper);
  return {text + "\n" + plot_link("memory", "Peak memory over the number of frames"), {{"memory", svg_of(plot)}}};
}

}  // namespace dspm
