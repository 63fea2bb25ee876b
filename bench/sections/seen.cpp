// After equal time: the error of what path finds and of what it does not, each on its own, so that neither hides the
// other.
#include "bench/measure/reference.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

constexpr double kReference = 6;  // each of the reference's three runs takes that many times as long as a method
constexpr const char* kIntegrators[] = {"path", "dsppm", "vcm"};

struct Example {
  std::string name;
  std::filesystem::path file;
  std::vector<std::string> defines = {};
  double times_as_long = 1;
  PixelRect apart = {};  // compared instead of what path does not find
};

// Below the ball of clear glass. The lamp is wide, so path finds what the glass throws, too, but late.
constexpr PixelRect kThrownByGlass = {176, 72, 208, 80};

std::vector<Example> examples(const Setup& setup) {
  if (!setup.scene.empty()) return {{setup.scene, setup.scene, setup.defines}};
  const std::filesystem::path light = std::filesystem::path(DSPM_SOURCE_DIR) / "bench/light";
  return {{"product", our_scene("product")},
          {"rough", light / "rough.dsc", {}, 1, kThrownByGlass},
          {"rough, 16 variations", light / "rough16.dsc", {}, 2, kThrownByGlass},
          {"house without lamps", light / "house.dsc", {"lamps=0"}},
          {"house with 50 lamps", light / "house.dsc", {"lamps=1"}}};
}

struct Errors {
  double pixels = 0, blocks = 0;
};

Errors errors_of(const Images& images, const Images& truth, const Part& part) {
  return {error_of(images, truth, part), error_of(in_blocks(images), in_blocks(truth), part)};
}

std::vector<std::string> cells_of(const Errors& errors, const Errors& of_path) {
  const auto over_path = [](double error, double path) { return path > 0 ? ratio_cell(error / path) : ""; };
  return {fmt::format("{:.4f}", errors.pixels), over_path(errors.pixels, of_path.pixels),
          fmt::format("{:.4f}", errors.blocks), over_path(errors.blocks, of_path.blocks)};
}

std::string measure_one(const Example& example, double seconds) {
  Choices choices;
  choices.defines = example.defines;
  const Comparison scene(example.file, choices);
  say("{}: reference", example.name);
  const Reference reference = make_reference(scene, kReference * seconds);
  const Part rest = example.apart.empty() ? reference.hidden : squares_in(example.apart, reference.truth);
  Table table({fmt::format("after {:.2g} s a frame", seconds / static_cast<double>(reference.truth.size())),
               "what path finds: pixels", "over path", "blocks", "over path",
               fmt::format("{}: pixels", example.apart.empty() ? "the rest" : "what glass throws"), "over path",
               "blocks", "over path"});
  Errors seen_by_path, apart_by_path;
  for (const char* integrator : kIntegrators) {
    say("{}: {}", example.name, integrator);
    const LoadedScene& loaded = scene.of(integrator);
    const Images images = render_for(loaded, {integrator, integrator, loaded.job}, seconds);
    const Errors seen = errors_of(images, reference.truth, reference.seen);
    const Errors apart = errors_of(images, reference.truth, rest);
    if (integrator == kIntegrators[0]) seen_by_path = seen, apart_by_path = apart;
    std::vector<std::string> cells = cells_of(seen, seen_by_path), more = cells_of(apart, apart_by_path);
    cells.insert(cells.begin(), integrator);
    cells.insert(cells.end(), more.begin(), more.end());
    table.row(cells);
  }
  const auto& size = scene.path.job.settings.crop;
  return fmt::format(
             "\n{}, {} of {} x {} pixels; path finds {} of the blocks; the reference's blocks are uncertain by {:.4f} "
             "there and by {:.4f} elsewhere:\n\n",
             example.name, scene.path.job.frames_in_words(), size.width(), size.height(),
             percent_cell(reference.seen.share()), reference.uncertain_seen, reference.uncertain_hidden) +
         table.text();
}

}  // namespace

Findings measure_seen(const Setup& setup) {
  const double seconds = setup.quick ? 2 : 8;
  std::string text;
  for (const Example& example : examples(setup)) {
    try {
      text += measure_one(example, example.times_as_long * seconds);
    } catch (const Skipped& why) {
      text += fmt::format("\n{}: SKIPPED, {}\n", example.name, why.what());
    }
  }
  return {text, {}};
}

}  // namespace dspm
