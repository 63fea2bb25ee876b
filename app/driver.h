// Renders a scene (makes the world, cuts the frames into intervals, iterates until it is time to stop, writes) or only
// checks it.
#pragma once

#include "app/options.h"

namespace dspm {

/// The exit code. Throws SceneError where the scene cannot be rendered, UsageError where the options do not fit it,
/// other exceptions of the standard library where files cannot be written.
int render_scene(const Options& options);
/// Makes everything that a render needs, tries its files and its video, plans its memory, and says so; likewise.
int check_scene(const Options& options);

}  // namespace dspm
