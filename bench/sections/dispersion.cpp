// Scenes with dispersion: all frames together against one by one, and how far a few iterations are from white.
#include <algorithm>
#include <cmath>

#include "bench/measure/turns.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/wavelength.h"

namespace dspm {
namespace {

/// Returns the largest difference from white, of any colour, of what `iterations` refract, over many seeds: its root mean square,
/// for wavelengths of the golden ratio, or for independent ones.
double away_from_white(int iterations, bool independent) {
  constexpr std::uint64_t kSeeds = 1000;
  double sum = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Spectrum hues;
    for (int i = 0; i < iterations; ++i) {
      const auto number = static_cast<std::uint64_t>(i);
      hues += hue(independent ? wavelength_of(seed * 1000 + number, 0) : wavelength_of(seed, number));
    }
    double largest = 0;
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(double{hues[c]} / iterations - 1));
    sum += largest * largest;
  }
  return std::sqrt(sum / static_cast<double>(kSeeds));
}

std::string whiteness() {
  Table table({"iterations", "1", "4", "16", "64", "256"});
  for (const bool independent : {false, true}) {
    std::vector<std::string> row{independent ? "independent wavelengths" : "dspm's"};
    for (const int iterations : {1, 4, 16, 64, 256})
      row.push_back(percent_cell(away_from_white(iterations, independent)));
    table.row(row);
  }
  return table.text();
}

}  // namespace

Findings measure_dispersion(const Setup& setup) {
  std::string details = "\nThe colour of what is refracted, away from white:\n\n" + whiteness();
  Table totals({"scene", "K", "speedup", "sharing factor", "reached"});
  for (const char* name : {"prism", "diamond"}) {
    try {
      say("{}", name);
      const LoadedScene loaded = load(our_scene(name));
      const InTurns turns = take_turns(loaded, loaded.job, {.iterations = setup.quick ? 3 : 6});
      totals.row({name, std::to_string(turns.frames), ratio_cell(turns.speedups.back()),
                  ratio_cell(turns.factors.back()), percent_cell(turns.speedups.back() / turns.factors.back())});
      details += fmt::format("\n{}, K = {}:\n\n{}", name, turns.frames, table_of(turns, nullptr));
    } catch (const Skipped& why) {
      details += fmt::format("\n{}: SKIPPED, {}\n", name, why.what());
    }
  }
  return {totals.text() + details, {}};
}

}  // namespace dspm
