// When the iterations of frames are exposed, and the scene that each of them sees. All paths and photons of an iteration
// see one time of the shutter, so photons and hit points meet there, and frames stay shared. [Cammarano and Jensen 2002] If
// things move fast, it is a few times, each of which some of the pixels see.
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

/// Returns how many moments of the shutter an iteration shows: several if something passes more than sixteen times its own width
/// while the shutter is open, or the camera turns that fast, and the integrator can show them. It depends on the frames that
/// stand for the file and on the picture's size alone. The job has it once it is loaded.
int moments_of_an_iteration(const Job& job, const World& opening, const World& closing);

/// Says for --explain what blurs; nothing if nothing does.
std::vector<std::string> explain_shutter(const Job& job);

class Exposure {
 public:
  /// `scene`, of the world, is that of all iterations if the shutter is closed; else it says which frames there are. All
  /// of them outlive the exposure.
  Exposure(const Job& job, const World& world, Scene& scene) : job_(job), world_(world), scene_(scene) {
    colour(scene_, 0);
  }

  /// Returns the iteration, whose scene lives until the next one is asked for. Throws SceneError if the scene at its
  /// time has errors.
  Iteration iteration(int number);

 private:
  /// Gives the scene the palette of the iteration, if the render is spectral.
  void colour(Scene& scene, int number);

  const Job& job_;
  const World& world_;
  Scene& scene_;
  struct Later {
    std::unique_ptr<const World> world;
    std::unique_ptr<Scene> scene;
  };
  std::vector<Later> later_;  // of the latest iteration
  std::vector<const Scene*> moments_;
};

}  // namespace dspm
