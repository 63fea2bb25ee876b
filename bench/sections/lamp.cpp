// An animator's 24 frames: a lamp dims, the camera moves, nothing else. Their time over that of 24 equal frames, and
// over that of one.
#include "bench/measure/rounds.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

constexpr double kAsked = 1.2;  // of a dimming lamp over a steady one; of photons for a moving camera over one frame's

struct Case {
  const char* name;
  double lamp, window, way;  // in bench/room.dsc
};
constexpr Case kCases[] = {{"nothing changes", 1, 1, 0},
                           {"one of two lamps dims", 0.1, 1, 0},
                           {"both lamps dim", 0.1, 0.1, 0},
                           {"the camera moves", 1, 1, 0.4},
                           {"one lamp dims, the camera moves", 0.1, 1, 0.4}};
enum : std::size_t { kSteady, kDims, kBothDim, kMoves };

LoadedScene room(const Case& c) {
  return load(std::filesystem::path(DSPM_SOURCE_DIR) / "bench/room.dsc",
              {fmt::format("lamp={}", c.lamp), fmt::format("window={}", c.window), fmt::format("way={}", c.way)});
}

/// Of all cases, then of one frame by dsppm and by sppm.
std::vector<Rounds> measure(int iterations) {
  std::vector<LoadedScene> rooms;
  std::vector<Group> groups;
  for (const Case& c : kCases) rooms.push_back(room(c));
  for (const LoadedScene& loaded : rooms) {
    groups.emplace_back();
    groups.back().push_back(start(loaded, loaded.job, "dsppm", loaded.job.frames));
  }
  const LoadedScene& steady = rooms[kSteady];
  for (const char* integrator : {"dsppm", "sppm"})
    groups.push_back(start_each(steady, steady.job, integrator, {steady.job.frames.front()}));
  return in_turns(groups, iterations);
}

std::vector<std::string> cells(std::string name, const StepSeconds& values, std::string (*cell)(double)) {
  std::vector<std::string> row = {std::move(name)};
  for (const double value : values) row.push_back(cell(value));
  return row;
}

std::string tables(const std::vector<Rounds>& rounds) {
  const std::size_t one = std::size(kCases);
  std::vector<std::string> head = {"24 frames, s"}, ratio_head = {"over one frame, dsppm"};
  for (const char* step : kStepNames) head.emplace_back(step), ratio_head.emplace_back(step);
  ratio_head.insert(ratio_head.end(), {"over one frame, sppm", "over nothing changes"});
  Table seconds(head), over(ratio_head);
  for (std::size_t i = 0; i < one; ++i) {
    seconds.row(cells(kCases[i].name, medians(rounds[i]), seconds_cell));
    std::vector<std::string> row = cells(kCases[i].name, ratios(rounds[i], rounds[one]), ratio_cell);
    row.push_back(ratio_cell(ratios(rounds[i], rounds[one + 1]).back()));
    row.push_back(ratio_cell(ratios(rounds[i], rounds[kSteady]).back()));
    over.row(row);
  }
  seconds.row(cells("one frame, dsppm", medians(rounds[one]), seconds_cell));
  seconds.row(cells("one frame, sppm", medians(rounds[one + 1]), seconds_cell));
  return seconds.text() + "\n" + over.text();
}

}  // namespace

Findings measure_lamp(const Setup& setup) {
  const std::vector<Rounds> rounds = measure(setup.quick ? 2 : 12);
  const Rounds& one = rounds[std::size(kCases)];
  const StepSeconds move = ratios(rounds[kMoves], one);
  return {
      fmt::format("{}\nA lamp that dims takes {:.2f} times as long as steady ones (required: at most {}), two of them "
                  "{:.2f} times. While the camera moves, photons take {:.2f} times as long as for one frame (required: "
                  "at most {}), everything {:.2f} times.\n",
                  tables(rounds), ratios(rounds[kDims], rounds[kSteady]).back(), kAsked,
                  ratios(rounds[kBothDim], rounds[kSteady]).back(), move[1], kAsked, move.back()),
      {}};
}

}  // namespace dspm
