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

std::vector<Method> methods(const Job& job, const Job& for_path, const Job& for_maps) {
  const auto dsppm = [&](const char* direct, const char* emission) {
    return with_text(with_text(job, "direct", direct), "emission", emission);
  };
  return {{"dsppm", "dsppm", dsppm("photons", "guided")},
          {"dsppm, emission by power", "dsppm", dsppm("photons", "power")},
          {"dsppm, direct light sampled", "dsppm", dsppm("sampled", "guided")},
          {"dsppm, direct light sampled, emission by power", "dsppm", dsppm("sampled", "power")},
          {"sppm", "sppm", job},
          {"photonmap", "photonmap", for_maps},
          {"path", "path", for_path}};
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
  const double seconds = setup.quick ? 4 : 20;
  const LoadedScene loaded = load(file, with(setup, "dsppm")), for_path = load(file, with(setup, "path")),
                    for_maps = load(file, with(setup, "photonmap"));
  const std::string name = file.stem().string();
  say("{}: reference", name);
  const Images truth = make_reference(loaded, kReference * seconds);
  std::vector<std::vector<ErrorPoint>> curves;
  const std::vector<Method> all = methods(loaded.job, for_path.job, for_maps.job);
  for (const Method& method : all) {
    say("{}: {}", name, method.name);
    const std::string_view integrator = method.integrator;
    const LoadedScene& scene = integrator == "path" ? for_path : integrator == "photonmap" ? for_maps : loaded;
    curves.push_back(converge(scene, method, truth, seconds));
  }
  Table table(
      {"method", fmt::format("error after {} s", seconds), "time to the error of emission by power, of its own"});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<ErrorPoint>& usual = curves[i < 2 ? 1 : 3];
    const double time = time_to(curves[i], error_after(usual, seconds));
    table.row({all[i].name, fmt::format("{:.4f}", error_after(curves[i], seconds)),
               i < 4 && time > 0 ? fmt::format("{:.3f}", time / std::min(seconds, usual.back().seconds)) : ""});
  }
  const auto& size = loaded.job.settings.crop;
  return fmt::format("\n{}, {} of {} x {} pixels:\n\n", name, loaded.job.frames_in_words(), size.width(),
                     size.height()) +
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
