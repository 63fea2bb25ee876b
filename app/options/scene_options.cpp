// The options that say what is rendered, and by which plugins.
#include <algorithm>
#include <iterator>

#include "dspm/app/options/option_group.h"

namespace dspm {
namespace {

void add_scene_options(CLI::App& app, Options& o) {
  app.add_option("scene", o.scenes,
                 "scene files (.dsc or .pbrt, optionally .gz; .glb, .gltf), read in this order; -: standard input")
      ->type_name("");
  app.add_option("-D", o.defines, "replace $name in the scene's text")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  app.add_option("--plugin", o.modules, "load the plugins of this module, such as ./libambient.so; may be repeated")
      ->allow_extra_args(false)
      ->check(kNamesAFile)
      ->type_name("FILE");
  app.add_option("--sandbox", o.sandbox, "for untrusted scenes: touch no file outside of DIR, load no plugins")
      ->check(kNamesAFile)
      ->type_name("DIR");
  app.add_flag("--lenient", o.lenient, "warn about unsupported features of pbrt instead of stopping");
  app.add_option("--animation", o.animation,
                 "which animation of a glTF file is shown; else the first, and those that move other things")
      ->type_name("NAME");
  app.add_option("--camera", o.camera,
                 "which camera of a glTF file looks, by its name or its number from 1; else the first")
      ->type_name("NAME");
  app.add_option("--studio", o.studio,
                 "camera, softboxes and ground for a glTF file: auto (what it lacks), on (whatever it has) or off")
      ->check(one_of({"auto", "on", "off"}))
      ->type_name("KIND");
  CLI::Option* const hdr = app.add_option("--hdr", o.hdr, "a picture of the sky that lights a glTF file");
  hdr->check(kNamesAFile)->type_name("FILE");
  app.add_option("--hdr-backdrop", o.hdr_backdrop,
                 "how the camera sees that picture: shown (the default), blurred, or hidden behind a plain grey")
      ->needs(hdr)
      ->check(one_of({"shown", "blurred", "hidden"}))
      ->type_name("KIND");
  app.add_flag("--explain", o.explain,
               "say what is shared between frames and what is not, and why; and where photons start");
  app.add_option("--integrator", o.integrator,
                 "dsppm, sppm, photonmap, path, vcm or ambientocclusion, whatever the scene says")
      ->type_name("NAME");
  CLI::Option* const shutter = app.add_option_function<double>(
      "--shutter", [&o](double frames) { o.shutter = frames; },
      "blur what moves within so many frames after each, whatever the camera says; 0.5: half of the time to the next");
  shutter->check(CLI::Range(0., 1000.).description(""))->type_name("FRAMES");
  app.add_flag_callback(
         "--no-blur", [&o] { o.shutter = 0; }, "show one moment a frame, whatever the camera says")
      ->excludes(shutter);
  app.add_option("--accel", o.accel, "the tree for ray queries: two-level, or bruteforce for tests")->type_name("NAME");
}

bool needs_scene(Task task) {
  constexpr Task kOthers[] = {Task::list,   Task::describe,   Task::new_plugin, Task::merge,
                              Task::doctor, Task::completion, Task::manual_page};
  return std::find(std::begin(kOthers), std::end(kOthers), task) == std::end(kOthers);
}

void check_scene_options(const Options& o) {
  if (needs_scene(o.task) && o.scenes.empty()) throw UsageError("no scene was given (dspm --help says how)");
  for (const std::string& define : o.defines)
    if (define.find('=') == define.npos || define.front() == '=')
      throw UsageError("-D " + define + ": expected name=value");
}

}  // namespace

const OptionGroup scene_options = {add_scene_options, check_scene_options};

}  // namespace dspm
