// Rendering from a program: what `dspm scene.dsc` does, with images in memory instead of files.
//
//   const auto scene = dspm::load_scene({"ball.dsc"});
//   dspm::Renderer renderer(scene);
//   while (renderer.iterations() < 16) renderer.iterate();
//   const dspm::Image image = renderer.image(0);
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/integrators/output_info.h"
#include "dspm/integrators/statistics.h"
#include "dspm/session/job/choices.h"

namespace dspm {

struct LoadedScene;

/// Receives each warning, as the program prints it.
using Warn = std::function<void(const std::string& text)>;
inline const Warn kIgnoreWarnings = [](const std::string&) {};

/// Reads a scene from files, as the command line does; for other choices, read it again. Throws SceneError with all of
/// its errors, and UsageError if a choice does not fit it.
std::shared_ptr<const LoadedScene> load_scene(const std::vector<std::string>& files, const Choices& choices = {},
                                              const Warn& warn = kIgnoreWarnings);

/// Frames count from 0, in the order in which the program writes them. More than 64 are rendered in intervals, which
/// all stay in memory.
class Renderer {
 public:
  /// Throws SceneError if the integrator cannot be made.
  explicit Renderer(std::shared_ptr<const LoadedScene> scene, const Warn& warn = kIgnoreWarnings);
  ~Renderer();

  /// The names of the frames: "12", "oak-red" or "oak-red 12".
  const std::vector<std::string>& labels() const;
  /// Runs one more iteration of all frames. Throws whatever an iteration throws; the renderer cannot be used after
  /// that.
  void iterate();
  /// The iterations that were done. wanted() is how many the scene or a choice asks for; 0 if there is no end.
  int iterations() const;
  int wanted() const;
  /// The names of all outputs; radiance first.
  const std::vector<std::string>& outputs() const;
  /// The estimate so far, with the bits that the program writes as 32-bit floats. Throws std::out_of_range if there is
  /// no such frame or output.
  Image image(int frame, const std::string& output = kRadiance) const;
  /// The statistics of each interval.
  std::vector<Statistics> statistics() const;
  /// The state after the iterations so far. load_state() continues from it in a renderer of the same scene and choices;
  /// that they are the same is the caller's responsibility. Both throw std::runtime_error if the integrator has no such
  /// state; load_state() also if the bytes are not one.
  std::string state() const;
  void load_state(std::string_view state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dspm
