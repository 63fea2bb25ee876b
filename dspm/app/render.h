// The tasks "render" and "check" of the command line: a session with its progress, checkpoints and files.
#pragma once

#include "dspm/app/options.h"

namespace dspm {

/// The exit code. Throws SceneError if the scene cannot be rendered, UsageError if the options do not fit it, other
/// exceptions of the standard library if files cannot be written.
int render_scene(const Options& options);
/// Makes everything that a render needs, tries its files and its video, plans its memory, and says so. Returns and
/// throws likewise.
int check_scene(const Options& options);

}  // namespace dspm
