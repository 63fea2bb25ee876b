// Scenes whose light hardly reaches what the camera sees: the error of every integrator after the same time, with
// photons that start where they are found and where they would start by the lights' power alone.
#include "bench/measure/convergence.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"

namespace dspm {
namespace {

constexpr double kReference = 4;  // each of the reference's two runs takes that many times as long as a method

std::vector<std::filesystem::path> scene_files(const Setup& setup) {
  if (!setup.scene.empty()) return {setup.scene};
  const std::filesystem::path ours = std::filesystem::path(DSPM_SOURCE_DIR) / "bench/light";
  return {foreign("bench/open.dsc"), ours / "rough.dsc", ours / "window.dsc", ours / "door.dsc"};
}

Choices with(const Setup& setup, const char* integrator) {
  Choices choices;
  choices.defines = setup.defines, choices.integrator = integrator;
  return choices;
}

/// A scene, loaded for integrators that take different parameters.
struct Loaded {
  LoadedScene photons, paths, maps, vcm;

  Loaded(const std::filesystem::path& file, const Setup& setup)
      : photons(load(file, with(setup, "dsppm"))),
        paths(load(file, with(setup, "path"))),
        maps(load(file, with(setup, "photonmap"))),
        vcm(load(file, with(setup, "vcm"))) {}
};

struct Compared {
  const LoadedScene& scene;
  Method method;
};

/// In pairs: photons start where they are found, as by default, and by power. The last has no photons.
std::vector<Compared> methods(const Loaded& loaded) {
  std::vector<Compared> all;
  const auto add = [&](const LoadedScene& scene, const char* name, const char* integrator, const Job& job) {
    all.push_back({scene, {name, integrator, job}});
    all.push_back(
        {scene, {fmt::format("{}, emission by power", name), integrator, with_text(job, "emission", "power")}});
  };
  const Job& job = loaded.photons.job;
  add(loaded.photons, "dsppm", "dsppm", job);
  add(loaded.photons, "dsppm, direct light by photons", "dsppm", with_text(job, "direct", "photons"));
  add(loaded.photons, "dsppm, direct light by rays", "dsppm", with_text(job, "direct", "sampled"));
  add(loaded.photons, "sppm", "sppm", job);
  add(loaded.maps, "photonmap", "photonmap", loaded.maps.job);
  add(loaded.vcm, "vcm", "vcm", loaded.vcm.job);
  all.push_back({loaded.paths, {"path", "path", loaded.paths.job}});
  return all;
}

Images make_reference(const LoadedScene& loaded, double seconds) {
  Images runs[2];
  for (int i = 0; i < 2; ++i) {
    Job job = with_number(loaded.job, "alpha", 0.5f);
    job.settings.seed += 1000 + static_cast<std::uint64_t>(i);
    runs[i] = render_for(loaded, {"reference", "dsppm", job}, seconds);
  }
  say("  uncertain by {:.4f}", error_of(runs[0], runs[1]) / 2);
  return mean_of(runs[0], runs[1]);
}

std::string measure_one(const std::filesystem::path& file, const Setup& setup) {
  const double seconds = setup.quick ? 4 : 10;
  const Loaded loaded(file, setup);
  const std::string name = file.stem().string();
  say("{}: reference", name);
  const Images truth = make_reference(loaded.photons, kReference * seconds);
  std::vector<std::vector<ErrorPoint>> curves;
  const std::vector<Compared> all = methods(loaded);
  for (const auto& [scene, method] : all) {
    say("{}: {}", name, method.name);
    curves.push_back(converge(scene, method, truth, seconds));
  }
  Table table(
      {"method", fmt::format("error after {} s", seconds), "time to the error of emission by power, of its own"});
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::string ratio;
    if (i % 2 == 0 && i + 1 < all.size()) {
      const std::vector<ErrorPoint>& usual = curves[i + 1];
      const double time = time_to(curves[i], error_after(usual, seconds));
      if (time > 0) ratio = fmt::format("{:.3f}", time / std::min(seconds, usual.back().seconds));
    }
    table.row({all[i].method.name, fmt::format("{:.4f}", error_after(curves[i], seconds)), ratio});
  }
  const Job& job = loaded.photons.job;
  const auto& size = job.settings.crop;
  return fmt::format("\n{}, {} of {} x {} pixels:\n\n", name, job.frames_in_words(), size.width(), size.height()) +
         table.text();
}

}  // namespace

Findings measure_light(const Setup& setup) {
  std::string text;
  for (const std::filesystem::path& file : scene_files(setup)) {
    try {
      text += measure_one(file, setup);
    } catch (const Skipped& why) {
      text += fmt::format("\n{}: SKIPPED, {}\n", file.stem().string(), why.what());
    }
  }
  return {text, {}};
}

}  // namespace dspm
