#include "dspm/app/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "dspm/app/options/options.h"
#include "dspm/app/run/render.h"
#include "dspm/app/run/signals.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/base/params/errors.h"
#include "dspm/base/system/file_access.h"
#include "dspm/base/system/standard_streams.h"
#include "dspm/session/load.h"
#include "dspm/session/load_modules.h"
#include "dspm/session/machines/find_link.h"
#include "dspm/session/messages.h"
#include "dspm/session/modules/all_plugins.h"
#include "dspm/session/modules/blame.h"
#include "dspm/session/out_of_memory.h"

namespace dspm {
namespace {

int check_installation(const Options& options) {
  const Diagnosis diagnosis = examine_installation(options.threads);
  print_data(diagnosis.text);
  return diagnosis.can_render ? 0 : 1;
}

/// `others` are machines that MPI has started together with this one, or null. Only the first machine does tasks that
/// do not render.
int run(const Options& options, Link* others) {
  const bool is_render = options.task == Task::render && !are_images(options);
  if (others == nullptr && options.block) throw UsageError("--block: of which machines? It is for mpirun");
  if (others != nullptr && is_render) return render_together(options, *others);
  if (others != nullptr && others->me() != 0) return 0;
  switch (options.task) {
    case Task::list: return print_data(list_plugins()), 0;
    case Task::describe: return print_data(describe_plugins(options.described)), 0;
    case Task::doctor: return check_installation(options);
    case Task::completion: return print_data(completion_for(options.shell)), 0;
    case Task::manual_page: return print_data(manual_page()), 0;
    case Task::new_plugin: return print_data(new_plugin(options.created[0], options.created[1], options.created[2])), 0;
    case Task::format: return print_data(formatted(options.scenes)), 0;
    case Task::upgrade: {
      Messages messages(options.quiet);
      return print_data(upgraded(options.scenes, options.lenient, messages)), 0;
    }
    case Task::to_dsc: return print_data(written_as_dsc(options)), 0;
    case Task::list_variations: return print_data(variation_names(options.scenes, options)), 0;
    case Task::compare:
    case Task::flicker: return look_at_images(options), 0;
    case Task::relight: return relight_images(options);
    case Task::merge: return merge_parts(options);
    case Task::plan: return print_data(plan_of(options)), 0;
    case Task::farm: return print_data(farm_job(options)), 0;
    case Task::check: return check_scene(options);
    case Task::render:
      if (!is_render) return look_at_images(options), 0;
      return render_scene(options);
  }
  return 0;
}

void confine(const Options& options) {
  if (options.sandbox.empty()) return;
  try {
    confine_files(options.sandbox);
  } catch (const std::runtime_error& error) {
    throw UsageError(fmt::format("--sandbox {}: {}", options.sandbox, error.what()));
  }
}

int run_or_inform(const std::vector<std::string>& arguments, Link* others) {
  try {
    const Options options = parse_options(arguments);
    confine(options);
    load_modules(options.modules);
    return run(options, others);
  } catch (const Information& information) {
    if (others == nullptr || others->me() == 0) print_data(information.text);
    return 0;
  }
}

}  // namespace

int run_command_line(const std::vector<std::string>& arguments) {
  std::unique_ptr<Link> others;
  const auto is_silent = [&] { return others != nullptr && others->me() != 0; };  // what is wrong is said once
  const auto say = [&](const std::string& what) {
    if (is_silent()) return;
    const LoadedModule* const module = module_that_threw();
    const std::string who = module != nullptr ? in_words(*module) + " threw: " : "";
    print_message(fmt::format("dspm: {}{}\n", who, what));
  };
  try {
    others = find_link();
    return run_or_inform(arguments, others.get());
  } catch (const UsageError& error) {
    say(error.what());
    return 2;
  } catch (const SceneError& error) {
    if (!is_silent()) print_message(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    say(fmt::format("{}: {}", error.path1().string(), error.code().message()));
  } catch (const std::exception& error) {
    say(is_out_of_memory(error) ? "out of memory" : error.what());
  } catch (...) {
    say("something that is not a std::exception");
  }
  return InterruptRequests::exit_code(1);
}

}  // namespace dspm
