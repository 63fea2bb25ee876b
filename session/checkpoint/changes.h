// A checkpoint goes on although variations were edited or removed since: frames that have them start anew, the others
// keep their state.
#pragma once

#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/session/checkpoint/checkpoint_file.h"
#include "dspm/session/job/frame_choice.h"
#include "dspm/session/job/job.h"
#include "dspm/session/messages.h"

namespace dspm {

class Changes {
 public:
  /// `sampling` is World::sampling() of the scene as it is now. Throws SceneError, with all that has changed, if no
  /// frame can go on, or something has changed that matters to all of them.
  Changes(const Job& job, const CheckpointFile::Render& then, const std::string& sampling);

  bool any() const { return !diagnostics_.all().empty(); }
  /// Warnings of what starts anew and why, and of what is not there any more.
  const Diagnostics& warnings() const { return diagnostics_; }
  /// For a run that would not render what starts anew: shows the warnings and throws UsageError.
  [[noreturn]] void refuse_only_new(Messages& messages) const;
  /// Returns an interval's places in the file as it is now. Frames that do not go on are given up.
  Places after(const Places& then) const;
  /// Returns the frames of an interval that start anew, in their places now.
  FrameList anew(const Places& then) const;

 private:
  bool goes_on(FileFrame then) const { return !anew_[static_cast<std::size_t>(moved_.combination_then(then))]; }

  const MovedFrames moved_;
  std::vector<bool> anew_;  // by combination then: it has changed, or is not there any more
  Diagnostics diagnostics_;
};

}  // namespace dspm
