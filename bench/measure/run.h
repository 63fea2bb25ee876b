// Integrators with their scenes, for comparisons.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/session/load.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Says why something cannot be measured here: its models are missing.
class Skipped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One of our scenes: scenes/NAME.dsc.
std::filesystem::path our_scene(const std::string& name);
/// A file or folder that is not ours and may be absent; throws Skipped if it is.
std::filesystem::path foreign(const std::string& name);

/// Throws Skipped if the scene or files that it names are missing, such as meshes that have not been made.
LoadedScene load(const std::filesystem::path& scene, const Choices& choices,
                 std::optional<FileFrame> only = std::nullopt);  // as if the file held that frame alone
/// With values for names in the scene's text, name=value.
LoadedScene load(const std::filesystem::path& scene, const std::vector<std::string>& defines = {});
/// The paper's first scene with its original models.
LoadedScene load_sibenik_horse(std::vector<std::string> defines = {});

struct Run {
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Integrator> integrator;
};

/// This integrator with the job's settings, on the scene.
std::unique_ptr<Integrator> start(Job job, const char* integrator, const Scene& scene);
/// The scene's own integrator with other settings, or another one.
Run start(const LoadedScene& loaded, Job job, const char* integrator, const std::vector<FileFrame>& frames);
/// The same for each of the frames alone.
std::vector<Run> start_each(const LoadedScene& loaded, const Job& job, const char* integrator,
                            const std::vector<FileFrame>& frames);

/// The job with another value of an integrator's parameter.
Job with_text(Job job, const char* name, const char* value);
Job with_integer(Job job, const char* name, int value);
Job with_number(Job job, const char* name, float value);

/// `count` of the frames, evenly spread, the first among them; all if there are fewer.
std::vector<FileFrame> spread_frames(const std::vector<FileFrame>& frames, std::size_t count);

/// Seconds of all steps so far.
double seconds(const Statistics& statistics);

/// The middle of the values, or the mean of the two in the middle; 0 of none.
double median(std::vector<double> values);
/// The median of a[i] / b[i]: of two that took turns.
double median_ratio(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace dspm
