#include "dspm/session/load.h"

#include <fmt/format.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/system/plain_text.h"
#include "dspm/base/system/read_file.h"
#include "dspm/base/system/readable.h"
#include "dspm/integrators/beside/surface_output_list.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/lang/formatter.h"
#include "dspm/lang/parse.h"
#include "dspm/lang/shape_run.h"
#include "dspm/lang/upgrade.h"
#include "dspm/session/exposure.h"
#include "dspm/session/job/frame_choice.h"
#include "dspm/session/load_modules.h"
#include "dspm/world/held_files.h"
#include "dspm/world/objects/kept_geometry.h"

namespace dspm {

gltf::Settings gltf_settings_of(const Choices& choices) {
  gltf::Settings settings;
  if (choices.page_fps > 0) settings.fps = choices.page_fps;
  settings.animation = choices.animation, settings.camera = choices.camera, settings.studio = choices.studio;
  settings.backdrop = choices.hdr_backdrop == "hidden"    ? gltf::Backdrop::hidden
                      : choices.hdr_backdrop == "blurred" ? gltf::Backdrop::blurred
                                                          : gltf::Backdrop::shown;
  if (!choices.hdr.empty()) settings.hdr = std::filesystem::absolute(choices.hdr).string();
  return settings;
}

namespace {

ParseOptions parse_options_of(const Choices& choices) {
  ParseOptions parse;
  for (const std::string& define : choices.defines) {
    const std::size_t sign = define.find('=');
    parse.defines[define.substr(0, sign)] = define.substr(sign + 1);
  }
  parse.variations = choices.variations, parse.known = choices.known;
  parse.gltf = gltf_settings_of(choices);
  return parse;
}

SourceFile file_of(const std::string& name, Diagnostics& diagnostics) {
  SourceFile file{name, {}};
  try {
    file.text = plain_text(read_input(name));
  } catch (const std::runtime_error& error) {
    diagnostics.error({}, fmt::format("cannot read \"{}\": {}", name, error.what()));
  }
  return file;
}

SceneDescription with_files_held(SceneDescription description, const Choices& choices, Diagnostics& diagnostics) {
  if (diagnostics.error_count() == 0) hold_missing_files(description, chosen_frames(description, choices), diagnostics);
  return description;
}

/// Places the camera. A scene that mirrors its view, as pbrt's do by Scale -1 1 1, continues to do so.
void place_camera(CameraUse& camera, const std::array<double, 9>& v) {
  const std::optional<Matrix4> place = Matrix4::look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
  if (!place) return;
  const std::optional<Matrix4> before = camera.camera_from_world.at(Moment()).inverse();
  const bool mirrors = before && Transform(*before).swaps_handedness() != Transform(*place).swaps_handedness();
  camera.camera_from_world = Motion(mirrors ? Matrix4::scale(-1, 1, 1) * *place : *place);
}

}  // namespace

LoadedScene::LoadedScene(const std::vector<std::string>& files, const Choices& choices, Messages& messages,
                         std::optional<FileFrame> only, KeptGeometry* kept) {
  Diagnostics diagnostics(choices.lenient);
  std::optional<StepTimer> reading(steps[0]);
  SceneDescription read = parse_files(files, parse_options_of(choices), diagnostics);
  reading.reset();
  if (only) read.frames = read.frames.only(*only);
  if (choices.look_at && read.camera) place_camera(*read.camera, *choices.look_at);
  description = std::make_unique<SceneDescription>(with_files_held(std::move(read), choices, diagnostics));
  make(choices, diagnostics, kept);
  messages.show(diagnostics);
  diagnostics.throw_if_errors();
  if (kept != nullptr) kept->scene_is_loaded();
}

LoadedScene::LoadedScene(const std::string& name, std::string text, const Choices& choices, Diagnostics& diagnostics)
    : description(std::make_unique<SceneDescription>(with_files_held(
          parse_text(name, std::move(text), parse_options_of(choices), diagnostics), choices, diagnostics))) {
  make(choices, diagnostics);
  diagnostics.throw_if_errors();
}

void LoadedScene::make(const Choices& choices, Diagnostics& diagnostics, KeptGeometry* kept) {
  const StepTimer timer(steps[1]);
  load_modules(*description, diagnostics);
  job = make_job(*description, choices, diagnostics);
  if (kept == nullptr && job.shutter.delays()) own_kept = std::make_shared<KeptGeometry>(true), kept = own_kept.get();
  WorldOptions world_options{job.settings.width, job.settings.height, job.accel, true, job.film.diagonal, kept,
                             &job.frames,        job.shutter.delays()};
  world_options.nearby = has_motion(job.settings.outputs);
  world = std::make_unique<World>(*description, world_options, diagnostics);
  if (what_moves(*description).empty() && !world->has_velocities()) job.shutter = {};
  if (job.shutter.delays() && diagnostics.error_count() == 0) look_at_shutter(diagnostics);
  job.settings.file = std::make_shared<FileSample>(
      world->sample_frames(), [world = world.get()] { return world->scene(world->sample_frames()); });
}

/// Shows errors and notes of the farther end early, and compares both.
void LoadedScene::look_at_shutter(Diagnostics& diagnostics) {
  const double open = job.shutter.open, close = job.shutter.close;
  const bool opens_farther = std::abs(open) > std::abs(close);
  const auto later = [&](double delay, bool is_farther) {
    return delay != 0 ? world->after(delay, is_farther ? &diagnostics : nullptr) : std::unique_ptr<World>();
  };
  const std::unique_ptr<World> opening = later(open, opens_farther), closing = later(close, !opens_farther);
  job.moments = moments_of_an_iteration(job, opening ? *opening : *world, closing ? *closing : *world);
}

std::string summary_of(const LoadedScene& loaded) {
  const SceneDescription& d = *loaded.description;
  const RenderSettings& settings = loaded.job.settings;
  return fmt::format("{}, {} x {} pixels, {}, {}, {}, {}", loaded.job.frames_in_words(), settings.width,
                     settings.height, counted(count_directives(d.shapes), "shape"),
                     counted(d.materials.size(), "material"), counted(d.lights.size() + d.area_lights.size(), "light"),
                     loaded.job.integrator);
}

std::string variation_names(const std::vector<std::string>& files, const Choices& choices) {
  Diagnostics diagnostics(choices.lenient);
  const SceneDescription description = parse_files(files, parse_options_of(choices), diagnostics);
  diagnostics.throw_if_errors();
  std::string names;
  std::size_t last = description.frames.combinations().size();
  for (const FileFrame frame : chosen_frames(description, choices)) {
    const std::size_t combination = description.frames.combination_of(frame);
    if (combination != last && !description.axes.empty()) names += description.frames.variation(frame) + "\n";
    last = combination;
  }
  return names;
}

std::string formatted(const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& name : files) {
    Diagnostics diagnostics;
    const SourceFile file = file_of(name, diagnostics);
    const std::optional<std::string> canonical = format_scene(file, diagnostics);
    diagnostics.throw_if_errors();
    text += canonical.value_or("");
  }
  return text;
}

std::string upgraded(const std::vector<std::string>& files, bool lenient, Messages& messages) {
  std::string text;
  for (const std::string& name : files) {
    Diagnostics diagnostics(lenient);
    const SourceFile file = file_of(name, diagnostics);
    const std::optional<std::string> canonical = upgrade_scene(file, diagnostics);
    messages.show(diagnostics);
    diagnostics.throw_if_errors();
    text += canonical.value_or("");
  }
  return text;
}

}  // namespace dspm
