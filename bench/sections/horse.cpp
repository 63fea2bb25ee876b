// WG12's table 1: a glass horse gallops through a cathedral, over the number of frames.
#include "bench/measure/turns.h"
#include "bench/plots/plots.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/gallop.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

constexpr const char* kEstimators[] = {"kz11", "hj09"};

struct Measured {
  std::string estimator;
  std::vector<InTurns> by_frames;  // ascending
};

const wg12::HorseRow* paper_row(int frames) {
  for (const wg12::HorseRow& row : wg12::kHorse)
    if (row.frames == frames) return &row;
  return nullptr;
}

/// One after the other; the scenes differ in their number of frames, which increases.
std::vector<Measured> measure_all(const std::vector<LoadedScene>& scenes, bool quick) {
  const TurnSettings settings{.iterations = quick ? 3 : 6, .separate = quick ? 4u : 64u};
  std::vector<Measured> all;
  for (const char* estimator : kEstimators) {
    all.push_back({estimator, {}});
    for (const LoadedScene& loaded : scenes) {
      say("{} at {} frames, {}", loaded.job.scene_file, loaded.job.frames.size(), estimator);
      const Job job = with_text(loaded.job, "estimator", estimator);
      all.back().by_frames.push_back(take_turns(loaded, job, settings));
    }
    if (quick) break;
  }
  return all;
}

std::string totals(const std::vector<Measured>& all) {
  std::vector<std::string> head = {"K"};
  for (const Measured& m : all) head.push_back("speedup, " + m.estimator);
  head.insert(head.end(), {"WG12", "dynamic photons", "dynamic hit points"});
  Table table(head);
  for (std::size_t k = 0; k < all.front().by_frames.size(); ++k) {
    const InTurns& c = all.front().by_frames[k];
    std::vector<std::string> cells = {std::to_string(c.frames)};
    for (const Measured& m : all) cells.push_back(ratio_cell(m.by_frames[k].speedups.back()));
    const wg12::HorseRow* paper = paper_row(c.frames);
    cells.push_back(paper != nullptr ? ratio_cell(paper->speedups.back()) : "");
    cells.push_back(percent_cell(c.dynamic_photons)), cells.push_back(percent_cell(c.dynamic_hit_points));
    table.row(cells);
  }
  return table.text();
}

std::string details(const std::vector<Measured>& all) {
  std::string text;
  for (const Measured& m : all) {
    for (const InTurns& c : m.by_frames) {
      const wg12::HorseRow* paper = paper_row(c.frames);
      text += fmt::format("\nK = {}, {}:\n\n{}", c.frames, m.estimator,
                          table_of(c, paper != nullptr ? &paper->speedups : nullptr));
    }
  }
  return text;
}

PlotFile plot_over_frames(const std::vector<Measured>& all) {
  LinePlot plot{.title = "Speedup of rendering K frames together", .x_label = "frames", .y_label = "speedup"};
  for (const Measured& m : all) {
    LineSeries series{m.estimator, {}};
    for (const InTurns& c : m.by_frames) {
      series.points.push_back({static_cast<double>(c.frames), c.speedups.back()});
      if (&m == &all.front()) plot.x_ticks.push_back(c.frames);
    }
    plot.series.push_back(series);
  }
  LineSeries paper{"WG12", {}, true};
  for (const wg12::HorseRow& row : wg12::kHorse)
    paper.points.push_back({static_cast<double>(row.frames), row.speedups.back()});
  plot.series.push_back(paper);
  return {"horse", svg_of(plot)};
}

}  // namespace

Findings measure_horse(const Setup& setup) {
  std::vector<LoadedScene> scenes;
  for (const int frames : setup.quick ? std::vector<int>{8, 32} : std::vector<int>{8, 16, 24, 32})
    scenes.push_back(load_gallop(frames));
  const std::vector<Measured> all = measure_all(scenes, setup.quick);
  return {totals(all) + "\n" + plot_link("horse", "Speedup over the number of frames") + "\n" + details(all),
          {plot_over_frames(all)}};
}

Findings measure_sibenik(const Setup& setup) {
  std::vector<LoadedScene> scenes;
  scenes.push_back(load_sibenik_horse());
  const std::vector<Measured> all = measure_all(scenes, setup.quick);
  return {totals(all) + details(all), {}};
}

}  // namespace dspm
