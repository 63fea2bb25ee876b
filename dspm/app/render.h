// The tasks "render" and "check" of the command line: a session with its progress, checkpoints and files.
#pragma once

#include <functional>

#include "dspm/app/run.h"

namespace dspm {

/// The exit code. Throws SceneError if the scene cannot be rendered, UsageError if the options do not fit it, other
/// exceptions of the standard library if files cannot be written.
int render_scene(const Options& options);
/// Makes everything that a render needs, tries its files and its video, plans its memory, and says so. Returns and
/// throws likewise.
int check_scene(const Options& options);

/// Leaves the job only the frames of the part of --part frames:3/8. Throws UsageError if there are none.
void take_part_of_frames(const Part& part, Job& job);

/// Loads the scene, and calls task(render, loaded scene) once all is ready to be written. `before`: called just before.
int load_and(const Options& options, const Surroundings& around, const std::function<void()>& before,
             const std::function<int(Render&, const LoadedScene&)>& task);

}  // namespace dspm
