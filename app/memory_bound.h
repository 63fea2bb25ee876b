// --memory: how many frames are rendered together, and how much their integrator may hold, so that the whole process
// keeps within the bound. What it holds is asked of malloc, so that the plan is the same on every run.
#pragma once

#include <vector>

#include "app/frame_intervals.h"
#include "app/job.h"
#include "app/messages.h"
#include "world/world.h"

namespace dspm {

class MemoryBound {
 public:
  /// To be made before the scene is read. 0: no bound.
  explicit MemoryBound(std::size_t bytes);

  /// The frames' intervals, as long as the bound allows and cut alike. Throws std::runtime_error with the
  /// figures where not even single frames fit. `writing`: what the images take while they are written.
  std::vector<FrameList> plan(const Job& job, const World& world, std::size_t writing, const Messages& messages);
  /// What an integrator may hold besides all that is held now; 0: no bound.
  std::size_t for_integrator() const;

 private:
  class Trials;
  std::size_t bytes_, writing_ = 0;
};

}  // namespace dspm
