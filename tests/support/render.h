// Renders scene text through the public interfaces, for tests of integrators.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "app/job.h"
#include "lang/parse.h"
#include "world/world.h"

namespace dspm::testing {

/// A scene's text with everything made from it.
class TestScene {
 public:
  /// Files that the text names are looked for beside `name`.
  explicit TestScene(std::string text, Options options = {}, const std::string& name = "test.dsc")
      : options_(std::move(options)), description_(parse_text(name, std::move(text), {}, diagnostics_)) {
    diagnostics_.throw_if_errors();
    job_ = make_job(description_, options_, diagnostics_);
    diagnostics_.throw_if_errors();
    world_ = std::make_unique<World>(
        description_, WorldOptions{job_.film.width, job_.film.height, options_.accel, true}, diagnostics_);
    diagnostics_.throw_if_errors();
  }

  int frame_count() const { return world_->frame_count(); }
  std::vector<Frame> all_frames() const {
    std::vector<Frame> frames(static_cast<std::size_t>(frame_count()));
    std::iota(frames.begin(), frames.end(), 0);
    return frames;
  }
  const Job& job() const { return job_; }
  const World& world() const { return *world_; }
  std::unique_ptr<Scene> scene(const std::vector<Frame>& frames) const { return world_->scene(frames); }
  /// The scene's integrator, or another that takes the same parameters, perhaps with a bound on its memory.
  std::unique_ptr<Integrator> integrator(const Scene& scene, const std::string& name = {}, std::size_t memory = 0) {
    Job job = job_;
    if (!name.empty())
      for (const auto& plugin : integrator_plugins())
        if (plugin.name == name) job.plugin = &plugin, job.integrator = name;
    auto made = job.make_integrator(scene, diagnostics_, memory);
    diagnostics_.throw_if_errors();
    return made;
  }
  /// One frame after that many iterations.
  Image render(Frame frame, int iterations, const std::string& name = {}) {
    const auto one = scene({frame});
    const auto made = integrator(*one, name);
    for (int i = 0; i < iterations; ++i) made->iterate(i);
    return made->estimate(0);
  }

 private:
  Options options_;
  Diagnostics diagnostics_;
  SceneDescription description_;
  Job job_;
  std::unique_ptr<World> world_;
};

}  // namespace dspm::testing
