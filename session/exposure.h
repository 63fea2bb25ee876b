// When the iterations of frames are exposed, and the scene that each of them sees. All paths and photons of an iteration
// see one time of the shutter, so photons and hit points meet there, and frames stay shared. [Cammarano and Jensen 2002]
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dspm/integrators/iteration.h"
#include "dspm/session/job/job.h"
#include "dspm/world/scene/scene.h"
#include "dspm/world/world.h"

namespace dspm {

/// Returns the time after each frame's moment of an iteration, in frames. Times cover the shutter evenly after any
/// number of iterations, in the blocks in which camera paths do.
double delay_of(int iteration, const Shutter& shutter, const RenderSettings& render);

/// Says for --explain what blurs; nothing if nothing does.
std::vector<std::string> explain_shutter(const Job& job);

class Exposure {
 public:
  /// `scene`, of the world, is that of all iterations if the shutter is closed; else it says which frames there are. All
  /// of them outlive the exposure.
  Exposure(const Job& job, const World& world, const Scene& scene) : job_(job), world_(world), scene_(scene) {}

  /// Returns the iteration, whose scene lives until the next one is asked for. Throws SceneError if the scene at its
  /// time has errors.
  Iteration iteration(int number);

 private:
  const Job& job_;
  const World& world_;
  const Scene& scene_;
  std::unique_ptr<const World> later_world_;  // of the latest iteration
  std::unique_ptr<const Scene> later_scene_;
};

}  // namespace dspm
