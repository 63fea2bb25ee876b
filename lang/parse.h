// The entry point of the language: scene files in, SceneDescription and diagnostics out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"
#include "dspm/lang/gltf/translation.h"
#include "dspm/lang/source_text.h"

namespace dspm {

struct ParseOptions {
  Defines defines = {};                      // from -D name=value
  std::vector<std::string> variations = {};  // patterns for those that are wanted, if there are too many
  std::optional<KnownFrames> known = {};     // of the run that is resumed
  gltf::Settings gltf = {};                  // how glTF files are read
};

/// Reads the files one after the other as if they were one; "-" is standard input. Errors go to `diagnostics`, up to
/// kErrorsShown of them; after an error, the description holds what could be read. It owns the files' texts, to which
/// the diagnostics refer: keep it while they are printed.
SceneDescription parse_files(const std::vector<std::string>& paths, const ParseOptions& options,
                             Diagnostics& diagnostics);

/// Reads a text in memory. Included files are looked for beside `name`, which need not exist.
SceneDescription parse_text(const std::string& name, std::string text, const ParseOptions& options,
                            Diagnostics& diagnostics);

}  // namespace dspm
