#include <fmt/format.h>

#include <filesystem>

#include "dspm/app/options/options.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/app/tasks/templates.h"
#include "dspm/base/system/parallel.h"
#include "dspm/session/can_part.h"
#include "dspm/session/load.h"
#include "dspm/session/stage.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

std::string in_shell(const std::vector<std::string>& words) {
  std::vector<std::string> quoted;
  for (const std::string& word : words) quoted.push_back(shell_word(word));
  return fmt::format("{}", fmt::join(quoted, " "));
}

int parts_of(const Options& options) { return options.farm_parts.value_or(8); }

/// Throws UsageError if parts cannot render, rather than let jobs fail on each machine of the farm.
void expect_parts_can_render(const Options& options) {
  const ThreadLimit threads(options.threads);
  Messages messages(true);  // of the scene, parts show them
  const LoadedScene loaded(options.scenes, options, messages);
  Stage stage(loaded, {loaded.job.frames.front()});
  const Integrator& integrator = stage.make_integrator(messages);
  expect_parts(loaded.job, integrator, "--farm " + options.farm);
  const int all = loaded.job.iterations(integrator);
  if (all == 0 && options.time_limit == 0)
    throw UsageError(fmt::format("--farm {}: of how many iterations? Give --iterations or --time-limit", options.farm));
  if (all > 0) expect_enough_iterations(all, {1, parts_of(options)}, fmt::format("--parts {}", parts_of(options)));
}

}  // namespace

std::vector<std::string> farms() { return {"slurm", "openjd", "flamenco"}; }

std::string farm_job(const Options& options) {
  expect_parts_can_render(options);
  const std::string name = fs::path(options.scenes.front()).stem().string();
  TemplateWords words = {{"dspm", shell_word(fs::read_symlink("/proc/self/exe").string())},
                         {"directory", shell_word(fs::current_path().string())},
                         {"folder", shell_word(name + ".parts")},
                         {"render", in_shell(options.words_of_render)},
                         {"images", in_shell(options.words_of_images)}};
  if (options.farm == "flamenco")
    for (auto& [word, value] : words) value = escaped(value, "\\`$");  // within a template literal of JavaScript
  words["name"] = words["scene"] = escaped(name, "\\\"");              // within double quotes
  words["parts"] = std::to_string(parts_of(options));
  return filled(template_text("farm." + options.farm), words);
}

}  // namespace dspm
