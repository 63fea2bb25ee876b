// WG12's table 3: a mirror ball in a discotheque, a drop that falls into water, a product that changes its colour.
#include "bench/measure/turns.h"
#include "bench/plots/plots.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

struct Measured {
  const wg12::SceneRow* paper;
  std::string estimator;
  InTurns comparison;
};

std::vector<Measured> measure_one(const wg12::SceneRow& paper, bool quick) {
  const LoadedScene loaded = load(our_scene(paper.name));
  std::vector<Measured> all;
  for (const char* estimator : {"kz11", "hj09"}) {
    say("{}, {}", paper.name, estimator);
    const TurnSettings settings{.iterations = quick ? 3 : 6, .separate = quick ? 3u : 64u};
    const Job job = with_text(loaded.job, "estimator", estimator);
    all.push_back({&paper, estimator, take_turns(loaded, job, settings)});
    if (quick) break;
  }
  return all;
}

std::string totals(const std::vector<Measured>& all) {
  Table table({"scene", "K", "estimator", "speedup", "sharing factor", "reached", "WG12", "dynamic photons", "WG12",
               "dynamic hit points", "WG12"});
  for (const Measured& m : all) {
    const InTurns& c = m.comparison;
    table.row({m.paper->name, std::to_string(c.frames), m.estimator, ratio_cell(c.speedups.back()),
               ratio_cell(c.factors.back()), percent_cell(c.speedups.back() / c.factors.back()),
               ratio_cell(m.paper->speedups.back()), percent_cell(c.dynamic_photons),
               percent_cell(m.paper->dynamic_photons), percent_cell(c.dynamic_hit_points),
               percent_cell(m.paper->dynamic_hit_points)});
  }
  return table.text();
}

PlotFile plot_of(const std::vector<Measured>& all) {
  BarPlot plot{
      "Speedup of rendering all frames together", "speedup", {}, {{"kz11", {}}, {"hj09", {}}, {"WG12", {}, true}}};
  for (const Measured& m : all) {
    if (plot.groups.empty() || plot.groups.back() != m.paper->name) {
      plot.groups.emplace_back(m.paper->name);
      for (BarSeries& series : plot.series) series.values.push_back(0);
      plot.series[2].values.back() = m.paper->speedups.back();
    }
    plot.series[m.estimator == "kz11" ? 0 : 1].values.back() = m.comparison.speedups.back();
  }
  return {"scenes", svg_of(plot)};
}

}  // namespace

Findings measure_scenes(const Setup& setup) {
  std::vector<Measured> all;
  std::string details;
  for (const wg12::SceneRow& paper : wg12::kScenes) {
    try {
      for (Measured& m : measure_one(paper, setup.quick)) {
        details += fmt::format("\n{}, K = {}, {}:\n\n{}", paper.name, m.comparison.frames, m.estimator,
                               table_of(m.comparison, &paper.speedups));
        all.push_back(std::move(m));
      }
    } catch (const Skipped& why) {
      details += fmt::format("\n{}: SKIPPED, {}\n", paper.name, why.what());
    }
  }
  if (all.empty()) return {details, {}};
  return {totals(all) + "\n" + plot_link("scenes", "Speedups beside WG12's") + "\n" + details, {plot_of(all)}};
}

}  // namespace dspm
