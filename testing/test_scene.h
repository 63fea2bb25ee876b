// A scene's text with everything made from it, as dspm itself makes it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/integrators/integrator.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

// For dspm's own tests: the headers are not installed.
struct Job;
struct Choices;
class World;

namespace test {

/// Throws SceneError for errors in the text.
class TestScene {
 public:
  /// Files that the text names are looked for next to `name`.
  explicit TestScene(std::string text, const std::string& name = "test.dsc");
  TestScene(std::string text, const Choices& choices, const std::string& name = "test.dsc");
  ~TestScene();

  int frame_count() const;
  std::vector<FileFrame> all_frames() const;
  /// The frames that the integrator renders together: all, or each alone.
  std::vector<std::vector<FileFrame>> intervals() const;

  std::unique_ptr<Scene> scene(const std::vector<FileFrame>& frames) const;
  /// Makes the scene's integrator, or another that takes the same parameters, perhaps with a bound on its memory.
  std::unique_ptr<Integrator> integrator(const Scene& scene, const std::string& name = {}, std::size_t memory = 0);

  /// Does the iterations from `first` to before `end`, each at its time of the shutter. The scene is one of these.
  void iterate(Integrator& integrator, Scene& scene, int first, int end) const;

  /// Renders one frame alone with that many iterations.
  Image render(FileFrame frame, int iterations, const std::string& name = {});
  /// Renders all frames, interval by interval.
  std::vector<Image> render_all(int iterations);
  /// Sets the seed of integrators that are made from now on. What they learn first they learn once, whatever the seed.
  void set_seed(std::uint64_t seed);

  const Job& job() const;
  const World& world() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace test
}  // namespace dspm
