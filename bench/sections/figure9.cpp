// WG12's figure 9: nine scenes, from few to many dynamic photons and from few to many dynamic hit points.
#include <algorithm>
#include <filesystem>

#include "bench/measure/turns.h"
#include "bench/plots/plots.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

constexpr std::size_t kSide = 3;

/// A side of the square of scenes, from few to most.
std::vector<std::string> amounts(bool quick) {
  return quick ? std::vector<std::string>{"few", "most"} : std::vector<std::string>{"few", "more", "most"};
}

/// Sorted by their shares of dynamic photons, then of dynamic hit points; a reduced run takes the corners of the
/// square.
std::vector<std::filesystem::path> scene_files(bool quick) {
  const std::filesystem::path folder = our_scene("figure9").replace_extension();
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".dsc") files.push_back(entry.path());
  if (files.size() != kSide * kSide) throw Skipped(fmt::format("figure9 has {} scenes instead of 9", files.size()));
  std::sort(files.begin(), files.end());
  if (!quick) return files;
  return {files[0], files[kSide - 1], files[(kSide - 1) * kSide], files[kSide * kSide - 1]};
}

/// Rows of rising shares of dynamic photons, in each of them rising shares of dynamic hit points.
void arrange(std::vector<InTurns>& found, std::ptrdiff_t side) {
  const auto by = [](double InTurns::*share) {
    return [share](const InTurns& a, const InTurns& b) { return a.*share < b.*share; };
  };
  std::sort(found.begin(), found.end(), by(&InTurns::dynamic_photons));
  for (auto row = found.begin(); row != found.end(); row += side)
    std::sort(row, row + side, by(&InTurns::dynamic_hit_points));
}

std::string cell(const InTurns& c) {
  return fmt::format("**{:.2f}** ({} photons, {} hit points)", c.speedups.back(), percent_cell(c.dynamic_photons),
                     percent_cell(c.dynamic_hit_points));
}

std::string table_of(const std::vector<InTurns>& found, const std::vector<std::string>& sides) {
  std::vector<std::string> head = {"dynamic photons"};
  for (const std::string& amount : sides) head.push_back(amount + " dynamic hit points");
  Table table(head);
  for (std::size_t row = 0; row < sides.size(); ++row) {
    std::vector<std::string> cells = {sides[row]};
    for (std::size_t i = 0; i < sides.size(); ++i) cells.push_back(cell(found[row * sides.size() + i]));
    table.row(cells);
  }
  return table.text();
}

PlotFile plot_of(const std::vector<InTurns>& found, const std::vector<std::string>& sides) {
  BarPlot plot{"Speedup by the shares of dynamic photons and hit points", "speedup", {}, {}};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    plot.groups.push_back(sides[i] + " dynamic photons");
    plot.series.push_back({sides[i] + " dynamic hit points", {}});
    for (std::size_t row = 0; row < sides.size(); ++row)
      plot.series[i].values.push_back(found[row * sides.size() + i].speedups.back());
  }
  return {"figure9", svg_of(plot)};
}

}  // namespace

Findings measure_figure9(const Setup& setup) {
  std::vector<InTurns> found;
  for (const std::filesystem::path& file : scene_files(setup.quick)) {
    say("figure9/{}", file.filename().string());
    const LoadedScene loaded = load(file);
    const TurnSettings settings{.iterations = setup.quick ? 2 : 4, .separate = setup.quick ? 2u : 64u};
    found.push_back(take_turns(loaded, loaded.job, settings));
  }
  const std::vector<std::string> sides = amounts(setup.quick);
  arrange(found, static_cast<std::ptrdiff_t>(sides.size()));
  const auto [least, most] = std::minmax_element(
      found.begin(), found.end(), [](const auto& a, const auto& b) { return a.speedups.back() < b.speedups.back(); });
  return {table_of(found, sides) + "\n" + plot_link("figure9", "The speedups") +
              fmt::format("\nFrom {:.2f} to {:.2f}; WG12: from {:.2f} to {:.2f}.\n", least->speedups.back(),
                          most->speedups.back(), wg12::kLeastSpeedup, wg12::kMostSpeedup),
          {plot_of(found, sides)}};
}

}  // namespace dspm
