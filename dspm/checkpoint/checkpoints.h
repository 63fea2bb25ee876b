// --checkpoint and --resume: a render that ends early goes on later, to the same bits.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dspm/checkpoint/checkpoint_file.h"
#include "dspm/session/messages.h"
#include "dspm/session/observer.h"
#include "dspm/session/write_schedule.h"

namespace dspm {

struct CheckpointSettings {
  std::string checkpoint, resume;            // files; empty: none
  std::optional<Interval> checkpoint_every;  // else every ten minutes
};

class Checkpoints {
 public:
  /// Throws UsageError where a checkpoint would be lost, SceneError with what has changed since the one to be resumed,
  /// std::runtime_error where it cannot be read.
  Checkpoints(const Job& job, const CheckpointSettings& settings, Messages& messages);

  /// Of the run that is resumed; empty: there is none.
  std::vector<FrameList> intervals() const;
  /// Of the run that is resumed, over all intervals.
  double seconds() const;

  /// Before the first iteration. Throws where the file cannot be written or is too large for the disk.
  void begin(const std::vector<FrameList>& intervals, Integrator& first);
  /// Loads where the interval stands; without a state, it is at its beginning.
  IntervalProgress resume(std::size_t interval, Integrator& integrator) const;
  bool due(int iterations) { return writes() && schedule_.due(iterations); }
  /// Does nothing where none is asked for. Throws WriteError.
  void save(const IntervalProgress& progress, Integrator& integrator);
  const std::filesystem::path& path() const { return path_; }

 private:
  bool writes() const { return !path_.empty(); }
  /// In the last one.
  std::vector<IntervalState> states() const;

  Messages& messages_;
  std::filesystem::path path_;  // empty: none is written
  Interval every_;
  WriteSchedule schedule_;
  std::vector<Fact> facts_;
  std::unique_ptr<const CheckpointFile> last_;  // resumed or written; null before begin(): none yet
};

}  // namespace dspm
