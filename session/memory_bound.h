// --memory: how many frames are rendered together, and how much their integrator may hold, so that the whole process
// stays within the bound. The same scene, settings and bound give the same plan, whatever the number of threads: until
// it is made there is only one thread, for which malloc reports exactly what it holds; the others get a fixed reserve.
#pragma once

#include <optional>
#include <vector>

#include "dspm/base/system/parallel.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/job/job.h"
#include "dspm/session/messages.h"
#include "dspm/session/observer.h"
#include "dspm/world/world.h"

namespace dspm {

class MemoryBound {
 public:
  /// Must be made before the scene is read; from then on there is only one thread. 0 means that there is no bound.
  explicit MemoryBound(std::size_t bytes);

  /// Memory that is held besides the scene and its integrator.
  struct Besides {
    /// The bytes held while images are written.
    std::size_t writing = 0;
    /// The number of the integrator's states, if several machines add up theirs: then there is a second integrator,
    /// too.
    std::size_t states = 0;
  };

  /// Returns the frames' intervals, as long as the bound allows and cut alike. Throws std::runtime_error with the
  /// figures if not even single frames fit. `given` holds the intervals of a resumed run, which are kept and come
  /// first; it may be empty. The `observer` may want an end.
  std::vector<FrameList> plan(const Job& job, const World& world, const Besides& besides,
                              const std::vector<FrameList>& given, const Messages& messages,
                              const SessionObserver& observer);
  /// Returns how many bytes the integrator of the plan's i-th interval may hold; 0 means that there is no bound.
  std::size_t for_integrator(std::size_t i) const { return bytes_ == 0 ? 0 : shares_[i]; }

 private:
  class Trials;
  std::size_t held() const;

  std::size_t bytes_, held_before_ = 0;
  std::optional<ThreadLimit> one_thread_;
  std::vector<std::size_t> shares_;
};

}  // namespace dspm
