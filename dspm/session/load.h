// From scene files to everything that a render needs.
#pragma once

#include <memory>
#include <optional>

#include "dspm/gltf/translation.h"
#include "dspm/integrators/statistics.h"
#include "dspm/math/frames.h"
#include "dspm/session/messages.h"
#include "dspm/world/job.h"
#include "dspm/world/world.h"

namespace dspm {

/// Throws SceneError with all errors of the scene; warnings and notes have been shown by then.
struct LoadedScene {
  /// `files`: one scene; "-": standard input. `only`: as if the file held that frame alone. `kept`: see WorldOptions.
  LoadedScene(const std::vector<std::string>& files, const Choices& choices, Messages& messages,
              std::optional<FileFrame> only = std::nullopt, KeptGeometry* kept = nullptr);
  /// Likewise, without Choices::look_at, from a text in memory; files that it names are looked for next to `name`.
  LoadedScene(const std::string& name, std::string text, const Choices& choices, Diagnostics& diagnostics);

  std::unique_ptr<const SceneDescription> description;  // locations in messages point into it
  Job job;
  std::unique_ptr<const World> world;
  std::vector<StepTime> steps = {{"reading the scene"}, {"making objects"}};

 private:
  void make(const Choices& choices, Diagnostics& diagnostics, KeptGeometry* kept = nullptr);
};

/// How glTF files are to be read.
gltf::Settings gltf_settings_of(const Choices& choices);

/// Frames, pixels, shapes, ... in one line.
std::string summary_of(const LoadedScene& loaded);

/// The names of the chosen variations, one per line; throws SceneError and UsageError, too.
std::string variation_names(const std::vector<std::string>& files, const Choices& choices);

/// The scene files' text in canonical form; throws SceneError if it cannot be read.
std::string formatted(const std::vector<std::string>& files);

/// pbrt-v3 files' text as one for v4; throws SceneError if one cannot be translated. Says what is only close.
std::string upgraded(const std::vector<std::string>& files, bool lenient, Messages& messages);

}  // namespace dspm
