// Warns if a run goes badly, by what its integrator has counted, and says what to do. Each warning comes once in a run:
// early if the rest of the run cannot mend it, else at the end of a frame interval.
#pragma once

#include <set>
#include <string>

#include "dspm/base/math/moments.h"
#include "dspm/integrators/statistics.h"
#include "dspm/session/job/job.h"
#include "dspm/session/messages.h"

namespace dspm {

class RunWarnings {
 public:
  static constexpr int kFirstLook = 8;
  /// Runs of fewer iterations are not judged by their photons and radius: their pictures are expected to be rough.
  static constexpr int kMoreThanAPreview = 32;

  RunWarnings(const Job& job, Messages& messages) : job_(job), messages_(messages) {}

  /// Looks at the statistics after iterations of a frame interval. `all` is the number of iterations in all, or those
  /// done if the interval has ended; 0 if it is unknown.
  void look(const Statistics& statistics, int all);
  /// Looks at the errors at the end of an interval of these frames: those that are zero, and what errors do not tell.
  void look_at_errors(const Statistics& statistics, const std::vector<FileFrame>& frames);

 private:
  void look_at_lone_paths(const Statistics& statistics);
  void warn_once(const std::string& what, const std::string& message, const std::string& hint);

  const Job& job_;
  Messages& messages_;
  std::set<std::string> warned_;
};

}  // namespace dspm
