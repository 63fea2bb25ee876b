#include "app/load.h"

#include <fmt/format.h>

#include "app/frame_choice.h"
#include "app/load_modules.h"
#include "core/read_file.h"
#include "lang/formatter.h"
#include "lang/parse.h"

namespace dspm {

namespace {

ParseOptions parse_options_of(const Options& options) {
  ParseOptions parse;
  for (const std::string& define : options.defines) {
    const std::size_t sign = define.find('=');
    parse.defines[define.substr(0, sign)] = define.substr(sign + 1);
  }
  parse.variations = options.variations;
  return parse;
}

}  // namespace

LoadedScene::LoadedScene(const Options& options, Messages& messages, std::optional<Frame> only) {
  Diagnostics diagnostics(options.lenient);
  SceneDescription read = parse_files(options.scenes, parse_options_of(options), diagnostics);
  if (only) read.frames = read.frames.only(*only);
  description = std::make_unique<SceneDescription>(std::move(read));
  make(options, diagnostics);
  messages.show(diagnostics);
  diagnostics.throw_if_errors();
}

LoadedScene::LoadedScene(const std::string& name, std::string text, const Options& options, Diagnostics& diagnostics)
    : description(std::make_unique<SceneDescription>(
          parse_text(name, std::move(text), parse_options_of(options), diagnostics))) {
  make(options, diagnostics);
  diagnostics.throw_if_errors();
}

void LoadedScene::make(const Options& options, Diagnostics& diagnostics) {
  load_modules(*description, diagnostics);
  job = make_job(*description, options, diagnostics);
  const WorldOptions world_options{job.settings.width, job.settings.height, job.accel, true};
  world = std::make_unique<World>(*description, world_options, diagnostics);
}

std::string summary_of(const LoadedScene& loaded) {
  const SceneDescription& d = *loaded.description;
  const RenderSettings& settings = loaded.job.settings;
  return fmt::format("{}, {} x {} pixels, {} shapes, {} materials, {} lights, {}", loaded.job.frames_in_words(),
                     settings.width, settings.height, d.shapes.size(), d.materials.size(),
                     d.lights.size() + d.area_lights.size(), loaded.job.integrator);
}

std::string variation_names(const Options& options) {
  Diagnostics diagnostics(options.lenient);
  const SceneDescription description = parse_files(options.scenes, parse_options_of(options), diagnostics);
  diagnostics.throw_if_errors();
  std::string names;
  std::size_t last = description.frames.combinations().size();
  for (const Frame frame : chosen_frames(description, options)) {
    const std::size_t combination = description.frames.combination_of(frame);
    if (combination != last && !description.axes.empty()) names += description.frames.variation(frame) + "\n";
    last = combination;
  }
  return names;
}

std::string formatted(const std::vector<std::string>& scenes) {
  std::string text;
  for (const std::string& scene : scenes) {
    SourceFile file{scene, {}};
    Diagnostics diagnostics;
    try {
      file.text = read_input(scene);
    } catch (const std::runtime_error& error) {
      diagnostics.error({}, fmt::format("cannot read \"{}\": {}", scene, error.what()));
    }
    const std::optional<std::string> canonical = format_scene(file, diagnostics);
    diagnostics.throw_if_errors();
    text += canonical.value_or("");
  }
  return text;
}

}  // namespace dspm
