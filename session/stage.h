// Where frames that are rendered together are rendered: their scene, the integrator that was made for it, and its
// iterations. Whoever renders gets them from a stage, so whatever iterations are to differ in is decided here.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "dspm/base/math/frames.h"
#include "dspm/base/params/errors.h"
#include "dspm/integrators/integrator.h"
#include "dspm/session/exposure.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/job/job.h"
#include "dspm/session/load.h"
#include "dspm/session/messages.h"
#include "dspm/world/scene/scene.h"
#include "dspm/world/world.h"

namespace dspm {

/// How a stage makes its integrator.
struct StageSettings {
  std::size_t memory = 0;  // the bytes that the integrator may hold; 0: no bound
  bool sees_all = true;    // false: its errors are not estimated, since it does not see all iterations
  /// Makes the integrator from two that are alike, if other machines help; may be empty.
  std::function<std::unique_ptr<Integrator>(std::unique_ptr<Integrator>, std::unique_ptr<Integrator>)> share_out = {};
  FrameSet given_up = {};  // frames whose images are no longer wanted
};

class Stage {
 public:
  /// Makes the scene. `job` and `world` outlive the stage.
  Stage(const Job& job, const World& world, FrameList frames);
  Stage(const LoadedScene& loaded, FrameList frames) : Stage(loaded.job, *loaded.world, std::move(frames)) {}

  const FrameList& frames() const { return frames_; }
  const Scene& scene() const { return *scene_; }

  /// Makes the integrator, in place of the one before. Shows warnings. Throws SceneError if the integrator cannot be
  /// made, and NotEnoughMemory.
  Integrator& make_integrator(Messages& messages, const StageSettings& settings = {});
  Integrator& integrator() const { return *integrator_; }

  Iteration iteration(int number) { return exposure_.iteration(number); }
  void iterate(int number) { integrator_->iterate(iteration(number)); }

 private:
  const Job& job_;
  const FrameList frames_;
  const std::unique_ptr<Scene> scene_;
  Exposure exposure_;
  std::unique_ptr<Integrator> integrator_;
};

/// Returns the job's integrator, for comparisons in which one scene has several; null if there were errors, which go to
/// `diagnostics`. Throws NotEnoughMemory.
std::unique_ptr<Integrator> make_integrator(const Job& job, const Scene& scene, Diagnostics& diagnostics,
                                            std::size_t memory = 0);

}  // namespace dspm
