#include "bench/measure/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "dspm/base/math/moments.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/session/stage.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

Job with_param(Job job, const char* name, ParamType type, decltype(Param::values) values) {
  std::erase_if(job.params.params, [&](const Param& p) { return p.name == name; });
  Param param;
  param.type = type, param.name = name, param.values = std::move(values);
  job.params.params.push_back(std::move(param));
  return job;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Whether all errors are missing files, such as meshes that have not been made.
bool lacks_files_only(const SceneError& error) {
  std::istringstream text(error.what());
  for (std::string line; std::getline(text, line);)
    if (line.find(": error: ") != line.npos && line.find("there is no file \"") == line.npos) return false;
  return true;
}

}  // namespace

std::filesystem::path our_scene(const std::string& name) {
  return std::filesystem::path(DSPM_SOURCE_DIR) / "scenes" / (name + ".dsc");
}

std::filesystem::path foreign(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(DSPM_TEST_DATA) / name;
  if (!std::filesystem::exists(path)) throw Skipped(fmt::format("{} is not on this machine", name));
  return path;
}

LoadedScene load(const std::filesystem::path& scene, const Choices& choices, std::optional<FileFrame> only) {
  if (!std::filesystem::exists(scene)) throw Skipped(fmt::format("there is no {}", scene.filename().string()));
  Messages messages(true);
  try {
    return LoadedScene({scene.string()}, choices, messages, only);
  } catch (const SceneError& error) {
    if (!lacks_files_only(error)) throw;
    throw Skipped(first_line(error.what()));
  }
}

LoadedScene load(const std::filesystem::path& scene, const std::vector<std::string>& defines) {
  Choices choices;
  choices.defines = defines;
  return load(scene, choices);
}

LoadedScene load_sibenik_horse(std::vector<std::string> defines) {
  defines.push_back("data=" + foreign("data/sibenik").parent_path().string());
  return load(std::filesystem::path(DSPM_SOURCE_DIR) / "bench/sibenik_horse.dsc", defines);
}

std::unique_ptr<Integrator> start(Job job, const char* integrator, const Scene& scene) {
  job.plugin = integrator_plugins().find(integrator), job.integrator = integrator;
  job.settings.file->forget();
  Diagnostics diagnostics;
  std::unique_ptr<Integrator> made = make_integrator(job, scene, diagnostics);
  diagnostics.throw_if_errors();
  return made;
}

Run start(const LoadedScene& loaded, Job job, const char* integrator, const std::vector<FileFrame>& frames) {
  Run run{loaded.world->scene(frames), nullptr};
  run.integrator = start(std::move(job), integrator, *run.scene);
  return run;
}

std::vector<Run> start_each(const LoadedScene& loaded, const Job& job, const char* integrator,
                            const std::vector<FileFrame>& frames) {
  std::vector<Run> runs;
  for (const FileFrame f : frames) runs.push_back(start(loaded, job, integrator, {f}));
  return runs;
}

Job with_text(Job job, const char* name, const char* value) {
  return with_param(std::move(job), name, ParamType::text, std::vector<std::string>{value});
}

Job with_integer(Job job, const char* name, int value) {
  return with_param(std::move(job), name, ParamType::integer, std::vector<int>{value});
}

Job with_number(Job job, const char* name, float value) {
  return with_param(std::move(job), name, ParamType::number, std::vector<float>{value});
}

std::vector<FileFrame> spread_frames(const std::vector<FileFrame>& frames, std::size_t count) {
  if (count >= frames.size()) return frames;
  std::vector<FileFrame> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(frames[i * frames.size() / count]);
  return some;
}

double seconds(const Statistics& statistics) {
  double sum = 0;
  for (const StepTime& step : statistics.steps) sum += step.seconds;
  return sum;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return median(std::move(ratios));
}

}  // namespace dspm
