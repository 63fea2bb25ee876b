// Every integrator with its defaults on scenes of every kind: the error of one frame after the same time.
#include "bench/report/table.h"

#include <algorithm>
#include <optional>

#include "bench/measure/convergence.h"
#include "bench/report/progress.h"
#include "bench/sections/sections.h"
#include "dspm/base/math/moments.h"

namespace dspm {
namespace {

constexpr double kReference = 4;  // each of the reference's two runs takes that many times as long as a method
constexpr const char* kIntegrators[] = {"dsppm", "vcm", "path", "sppm", "photonmap"};

struct Example {
  std::string name;
  std::filesystem::path file;  // may be relative to the shared data
  bool at_a_quarter = true;    // of the resolution
  std::vector<std::string> defines = {};
};

std::vector<Example> examples(const Setup& setup) {
  if (!setup.scene.empty()) return {{setup.scene, setup.scene, false, setup.defines}};
  const std::filesystem::path light = std::filesystem::path(DSPM_SOURCE_DIR) / "bench/light";
  std::vector<Example> all = {{"veach-mis", "data/pbrt/veach-mis/scene-v4.pbrt"},
                              {"cornell-box", "data/pbrt/cornell-box/scene-v4.pbrt"},
                              {"water-caustic", "data/pbrt/water-caustic/scene-v4.pbrt"},
                              {"open", "bench/open.dsc", false}};
  for (const char* name : {"product", "horse", "disco", "lamp"}) all.push_back({name, our_scene(name)});
  all.push_back({"rough", light / "rough.dsc", false});
  all.push_back({"house with 50 lamps", light / "house.dsc", false, {"lamps=1"}});
  all.push_back({"the same without", light / "house.dsc", false, {"lamps=0"}});
  if (setup.quick) all.erase(all.begin(), all.end() - 3);
  return all;
}

LoadedScene load_for(const Example& example, const char* integrator) {
  Choices choices;
  choices.defines = example.defines, choices.quick = example.at_a_quarter;
  choices.integrator = integrator;
  return load(example.file.is_absolute() ? example.file : foreign(example.file.string()), choices, FileFrame(0));
}

struct Row {
  std::vector<double> errors;  // by integrator
  double uncertainty = 0;
};

Row measure_one(const Example& example, double seconds) {
  const LoadedScene for_reference = load_for(example, "dsppm");
  Images runs[2];
  for (int i = 0; i < 2; ++i) {
    say("{}: reference", example.name);
    Job job = with_number(for_reference.job, "alpha", 0.5f);
    job.settings.seed += 1000 + static_cast<std::uint64_t>(i);
    runs[i] = render_for(for_reference, {"reference", "dsppm", job}, kReference * seconds);
  }
  const Images truth = mean_of(runs[0], runs[1]);
  Row row{{}, error_of(runs[0], runs[1]) / 2};
  for (const char* integrator : kIntegrators) {
    say("{}: {}", example.name, integrator);
    const LoadedScene loaded = load_for(example, integrator);
    row.errors.push_back(error_after(converge(loaded, {integrator, integrator, loaded.job}, truth, seconds), seconds));
  }
  return row;
}

// The smallest error is bold.
std::vector<std::string> cells_of(const std::string& name, const Row& row) {
  const double best = *std::min_element(row.errors.begin(), row.errors.end());
  std::vector<std::string> cells(1 + row.errors.size() + 1);
  cells.front() = name;
  std::transform(row.errors.begin(), row.errors.end(), cells.begin() + 1, [best](double error) {
    return error == best ? fmt::format("**{:.4f}**", error) : fmt::format("{:.4f}", error);
  });
  cells.back() = fmt::format("{:.4f}", row.uncertainty);
  return cells;
}

}  // namespace

Findings measure_table(const Setup& setup) {
  const double seconds = setup.quick ? 2 : 5;
  std::vector<std::string> head(std::begin(kIntegrators), std::end(kIntegrators));
  head.insert(head.begin(), fmt::format("error after {} s", seconds));
  head.insert(head.end(), "the reference is uncertain by");
  Table table(head);
  std::string skipped;
  for (const Example& example : examples(setup)) {
    try {
      table.row(cells_of(example.name, measure_one(example, seconds)));
    } catch (const Skipped& why) {
      skipped += fmt::format("\n{}: SKIPPED, {}\n", example.name, why.what());
    }
  }
  return {table.text() + skipped, {}};
}

}  // namespace dspm
