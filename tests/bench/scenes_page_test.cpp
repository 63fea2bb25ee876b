// The table of docs/scenes.md quotes docs/results.md: each share of dynamic paths is the one that was measured.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "bench/measure/run.h"
#include "dspm/base/system/read_file.h"

namespace dspm {
namespace scenes_page_test {

using Cells = std::vector<std::string>;

std::string text_of(const char* file) { return read_file(std::filesystem::path(DSPM_SOURCE_DIR) / file); }

/// "| a | b |"
Cells cells_of(const std::string& line) {
  Cells cells;
  std::istringstream in(line.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t begin = cell.find_first_not_of(' '), end = cell.find_last_not_of(' ');
    cells.push_back(begin == cell.npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

/// The rows of the first table that stands after `mark`, by their first cell.
std::map<std::string, Cells> table_after(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  EXPECT_NE(at, text.npos) << mark;
  std::istringstream in(text.substr(std::min(at, text.size())));
  std::map<std::string, Cells> rows;
  bool within = false;
  for (std::string line; std::getline(in, line) && (!within || line.rfind('|', 0) == 0);) {
    within |= line.rfind('|', 0) == 0;
    if (within) rows.emplace(cells_of(line).at(0), cells_of(line));
  }
  return rows;
}

Cells quoted(const std::string& scene) {
  for (const auto& [name, cells] : table_after(text_of("docs/scenes.md"), "| scene |"))
    if (name.rfind("[" + scene + "]", 0) == 0) return {cells.at(3), cells.at(4)};
  ADD_FAILURE() << scene << " is not in the table of docs/scenes.md";
  return {};
}

TEST(ScenesPage, QuotesTheMeasuredShares) {
  const std::string results = text_of("docs/results.md");
  const auto scenes = table_after(results, "<!-- figures: scenes -->"),
             horse = table_after(results, "<!-- figures: horse -->");
  for (const char* name : {"disco", "water", "material"})
    EXPECT_EQ(quoted(name), (Cells{scenes.at(name).at(7), scenes.at(name).at(9)})) << name;
  EXPECT_EQ(quoted("horse"), (Cells{horse.at("24").at(4), horse.at("24").at(5)}));
}

// One iteration of 77,000 camera paths, and more photon paths: standard deviations of at most 0.2%.
TEST(ScenesPage, QuotesTheSharesOfTheDemo) {
  const LoadedScene loaded = load(our_scene("demo"));
  const auto run = start(loaded, loaded.job, "dsppm", loaded.job.frames);
  run.integrator->iterate({0, *run.scene});
  const Statistics s = run.integrator->statistics();
  const Cells cells = quoted("demo");
  EXPECT_NEAR(std::stod(cells.at(0)), 100 * s.photon.dynamic_share(), 0.6);
  EXPECT_NEAR(std::stod(cells.at(1)), 100 * s.camera.dynamic_share(), 0.6);
}

}  // namespace scenes_page_test
}  // namespace dspm
