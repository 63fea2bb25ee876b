// --save-guide and --guide: what a run learned about where photons start, for other runs of the same scene, also in
// another size, or with other frames, another crop, seed or number of photons.
#pragma once

#include <filesystem>

#include "dspm/session/job/job.h"

namespace dspm {

/// Saves what the job's integrators have learned, even if it is that no guide pays. Throws WriteError, and UsageError
/// if they have learned nothing.
void save_guide(const std::filesystem::path& path, const Job& job);

/// Makes the job's integrators learn nothing of their own; one that would need to throws UsageError. Call it after the
/// world is made. Throws SceneError with what has changed since the guide was learned, std::runtime_error if the file
/// is not a guide.
void load_guide(const std::filesystem::path& path, const Job& job);
/// Throws UsageError if an integrator was made and did not ask for it.
void expect_guide_is_used(const std::filesystem::path& path, const Job& job);

}  // namespace dspm
