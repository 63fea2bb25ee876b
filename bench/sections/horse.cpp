// WG12's table 1: a glass horse gallops through a cathedral, over the number of frames.
#include "bench/measure/turns.h"
#include "bench/plots/plots.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

constexpr const char* kEstimators[] = {"kz11", "hj09"};

struct Measured {
  std::string estimator;
  std::vector<Comparison> by_frames;  // ascending
};

const wg12::HorseRow* paper_row(int frames) {
  for (const wg12::HorseRow& row : wg12::kHorse)
    if (row.frames == frames) return &row;
  return nullptr;
}

/// Frames left out evenly, as the paper did; the largest group first.
std::vector<std::vector<Frame>> groups_of(const std::vector<Frame>& frames, const std::vector<std::size_t>& counts) {
  std::vector<std::vector<Frame>> groups;
  for (auto count = counts.rbegin(); count != counts.rend(); ++count) groups.push_back(spread_frames(frames, *count));
  return groups;
}

std::vector<Measured> measure_all(const LoadedScene& loaded, const std::vector<std::size_t>& counts, bool quick) {
  const TurnSettings settings{.iterations = quick ? 3 : 6, .separate = quick ? 4u : 64u};
  const std::vector<std::vector<Frame>> groups = groups_of(loaded.job.frames, counts);
  std::vector<Measured> all;
  for (const char* estimator : kEstimators) {
    say("{} at {} frames, {}", loaded.job.scene_file, groups.front().size(), estimator);
    std::vector<Comparison> found = take_turns(loaded, with_text(loaded.job, "estimator", estimator), groups, settings);
    all.push_back({estimator, {found.rbegin(), found.rend()}});
  }
  return all;
}

std::string totals(const std::vector<Measured>& all) {
  std::vector<std::string> head = {"K"};
  for (const Measured& m : all) head.push_back("speedup, " + m.estimator);
  head.insert(head.end(), {"WG12", "dynamic photons", "dynamic hit points"});
  Table table(head);
  for (std::size_t k = 0; k < all.front().by_frames.size(); ++k) {
    const Comparison& c = all.front().by_frames[k];
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
    for (const Comparison& c : m.by_frames) {
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
    for (const Comparison& c : m.by_frames) {
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
  const LoadedScene loaded = load(our_scene("horse"));
  const std::vector<std::size_t> counts =
      setup.quick ? std::vector<std::size_t>{8, 32} : std::vector<std::size_t>{8, 16, 24, 32};
  const std::vector<Measured> all = measure_all(loaded, counts, setup.quick);
  return {totals(all) + "\n" + plot_link("horse", "Speedup over the number of frames") + "\n" + details(all),
          {plot_over_frames(all)}};
}

Findings measure_sibenik(const Setup& setup) {
  const LoadedScene loaded = load_sibenik_horse();
  const std::vector<Measured> all = measure_all(loaded, {loaded.job.frames.size()}, setup.quick);
  return {totals(all) + details(all), {}};
}

}  // namespace dspm
