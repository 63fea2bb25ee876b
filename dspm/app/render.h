// The tasks "render" and "check" of the command line: a session with its progress, checkpoints and files.
#pragma once

#include <functional>
#include <memory>

#include "dspm/app/run.h"
#include "dspm/machines/link.h"

namespace dspm {

/// The exit code. `others`: machines that help, or null. Throws SceneError if the scene cannot be rendered, UsageError
/// if the options do not fit it, other exceptions of the standard library if files cannot be written.
int render_scene(const Options& options, Link* others = nullptr);
/// Makes everything that a render needs, tries its files and its video, plans its memory, and says so. Returns and
/// throws likewise.
int check_scene(const Options& options);

/// Null if there is none.
std::unique_ptr<const CheckpointFile> file_to_resume(const Options& options);
/// What is rendered: the options, and the frames that a checkpoint to go on from knows; it may be null.
Choices choices_of(const Options& options, const CheckpointFile* resumed);
/// What the options say of a job besides, and what is learned for it. `together`: with other machines.
void prepare(const Options& options, const CheckpointFile* resumed, bool together, Job& job);

/// Leaves the job only the frames of the part of --part frames:3/8. Throws UsageError if there are none.
void take_part_of_frames(const Part& part, Job& job);

/// Loads the scene, and calls task(render, loaded scene) once all is ready to be written. `before`: called just before.
int load_and(const Options& options, const Surroundings& around, const std::function<void()>& before,
             const std::function<int(Render&, const LoadedScene&)>& task);

}  // namespace dspm
