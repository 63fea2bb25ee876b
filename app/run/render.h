// The tasks "render" and "check" of the command line: a session with its progress, checkpoints and files.
#pragma once

#include <functional>
#include <memory>

#include "dspm/app/run/run.h"
#include "dspm/session/machines/link.h"

namespace dspm {

/// Renders a scene and returns the exit code. `others` are machines that help, or null. Throws SceneError if the scene
/// cannot be rendered, UsageError if the options do not fit it, other exceptions of the standard library if files
/// cannot be written.
int render_scene(const Options& options, Link* others = nullptr);
/// Makes everything that a render needs, tries its files and its video, plans its memory, and says so. Returns and
/// throws what render_scene() does.
int check_scene(const Options& options);

/// Returns null if there is no file to resume.
std::unique_ptr<const CheckpointFile> file_to_resume(const Options& options);
/// Returns what is rendered: the options, and the frames that a checkpoint to go on from knows; `resumed` may be null.
Choices choices_of(const Options& options, const CheckpointFile* resumed);
/// Adds to the job what else the options say of it, and what is learned for it. `together` means with other machines.
void prepare(const Options& options, const CheckpointFile* resumed, bool together, Job& job);

/// Leaves the job only the frames of the part of --part frames:3/8. Throws UsageError if there are none.
void take_part_of_frames(const Part& part, Job& job);

/// Loads the scene, and calls task(render, loaded scene) once all is ready to be written. Calls `before` just before
/// that.
int load_and(const Options& options, const Surroundings& around, const std::function<void()>& before,
             const std::function<int(Render&, const LoadedScene&)>& task);

}  // namespace dspm
