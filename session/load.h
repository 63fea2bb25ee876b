// Loads everything that a render needs from scene files.
#pragma once

#include <memory>
#include <optional>

#include "dspm/base/math/moments.h"
#include "dspm/integrators/statistics.h"
#include "dspm/lang/gltf/translation.h"
#include "dspm/session/job/job.h"
#include "dspm/session/messages.h"
#include "dspm/world/world.h"

namespace dspm {

/// Throws SceneError with all errors of the scene; warnings and notes have been shown by then.
struct LoadedScene {
  /// Reads one scene from `files`; "-" is standard input. `only` makes it as if the file held that frame alone. For
  /// `kept`, see WorldOptions.
  LoadedScene(const std::vector<std::string>& files, const Choices& choices, Messages& messages,
              std::optional<FileFrame> only = std::nullopt, KeptGeometry* kept = nullptr);
  /// Reads a text in memory, without Choices::look_at; files that it names are looked for next to `name`.
  LoadedScene(const std::string& name, std::string text, const Choices& choices, Diagnostics& diagnostics);

  std::unique_ptr<const SceneDescription> description;  // locations in messages point into it
  Job job;
  std::shared_ptr<KeptGeometry>
      own_kept;  // what the worlds of an open shutter have in common, unless a caller keeps it
  std::unique_ptr<const World> world;
  std::vector<StepTime> steps = {{"reading the scene"}, {"making objects"}};

 private:
  void make(const Choices& choices, Diagnostics& diagnostics, KeptGeometry* kept = nullptr);
  void look_at_shutter(Diagnostics& diagnostics);
};

/// Returns how glTF files are to be read.
gltf::Settings gltf_settings_of(const Choices& choices);

/// Returns one line: frames, pixels, shapes, ...
std::string summary_of(const LoadedScene& loaded);

/// Returns the names of the chosen variations, one per line; throws SceneError and UsageError, too.
std::string variation_names(const std::vector<std::string>& files, const Choices& choices);

/// Returns the scene files' text in canonical form; throws SceneError if it cannot be read.
std::string formatted(const std::vector<std::string>& files);

/// Translates pbrt-v3 files into text for v4; throws SceneError if one cannot be translated. Says what is only close.
std::string upgraded(const std::vector<std::string>& files, bool lenient, Messages& messages);

}  // namespace dspm
