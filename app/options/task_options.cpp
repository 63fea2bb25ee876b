// The options that say what to do instead of rendering.
#include "dspm/app/options/option_group.h"
#include "dspm/app/tasks/tasks.h"

namespace dspm {
namespace {

void add_task_options(CLI::App& app, Options& o) {
  const auto task = [&](const char* name, Task what, const char* sentence) {
    app.add_flag_callback(name, [&o, what] { o.task = what; })->description(sentence);
  };
  task("--check", Task::check, "do not render, only validate everything: the scene, the files, the video, the memory");
  task("--format", Task::format, "do not render, print the scene in canonical form");
  task("--upgrade", Task::upgrade, "do not render, print a file for pbrt-v3 as one for pbrt-v4");
  task("--to-dsc", Task::to_dsc,
       "do not render, write a glTF file as a .dsc, with its meshes and pictures in a folder beside it");
  task("--list", Task::list, "print the names of all plugins");
  task("--doctor", Task::doctor, "check the installation: what works, what is missing, and what would bring it");
  task("--man-page", Task::manual_page, "print the manual page, for man");
  app.add_option_function<std::string>(
         "--completion", [&o](const std::string& shell) { o.task = Task::completion, o.shell = shell; },
         "print a script that makes a shell complete dspm's options: bash, zsh or fish")
      ->check(one_of(completing_shells()))
      ->type_name("SHELL");
  task("--list-variations", Task::list_variations, "print the names of the scene's variations");
  task("--relight", Task::relight,
       "do not render, mix images' light groups again: dspm --relight a.exr \"key 0.5 [1 .8 .6]\" -o b.exr");
  add_text(app, "--describe", "[KIND:]NAME", "print a plugin's parameters, such as those of material:dielectric",
           [&](const std::string& name) { o.task = Task::describe, o.described = name; });
  app.add_option_function<std::vector<std::string>>(
         "--new-plugin", [&](const std::vector<std::string>& words) { o.task = Task::new_plugin, o.created = words; },
         "write a starter project for a plugin: integrator ambient my-folder")
      ->expected(3)
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw)  // else it counts to three no more
      ->type_name("KIND NAME DIR");
}

}  // namespace

const OptionGroup task_options = {add_task_options, nullptr};

}  // namespace dspm
