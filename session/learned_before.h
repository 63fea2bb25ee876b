// Keeps what the last run has learned about where photons start, for the coarse iterations after an edit.
#pragma once

#include <memory>

#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/session/job/job.h"

namespace dspm {

class LearnedBefore {
 public:
  /// Keeps what a run has learned, which may have ended before it had learned anything.
  void keep(const Job& job) {
    if (job.settings.file->has_learned()) learned_ = job.settings.file->learned();
  }
  /// Makes the job use it and learn nothing of its own.
  void give(Job& job) const { job.settings.file = learned_.empty() ? nullptr : std::make_shared<FileSample>(learned_); }

 private:
  FileSample::Learned learned_;
};

}  // namespace dspm
