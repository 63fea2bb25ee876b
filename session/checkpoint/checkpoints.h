// --checkpoint and --resume: a render that ends early continues later, and ends with the same bits.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dspm/session/checkpoint/checkpoint_file.h"
#include "dspm/session/messages.h"
#include "dspm/session/observer.h"
#include "dspm/session/write_schedule.h"

namespace dspm {

struct CheckpointSettings {
  std::string checkpoint, resume;            // files; empty: none
  std::optional<Interval> checkpoint_every;  // else every ten minutes
  Part part = {};
  std::size_t memory = 0;          // bytes that a run may take; 0: no bound
  std::vector<std::string> words;  // of the command line
};

class Checkpoints {
 public:
  /// `sampling` is the job's World::sampling(). `resumed` is the file of settings.resume, or null; the run goes on with
  /// the job's frames, and keeps others as they are. Warns of frames that start anew. Throws UsageError if a checkpoint
  /// would be lost, SceneError with what has changed since the one to resume, std::runtime_error if it is damaged.
  Checkpoints(const Job& job, const std::string& sampling, const CheckpointSettings& settings,
              std::unique_ptr<const CheckpointFile> resumed, Messages& messages);

  ~Checkpoints();
  Checkpoints(const Checkpoints&) = delete;
  Checkpoints& operator=(const Checkpoints&) = delete;

  /// Returns the places of the intervals that the resumed run began and this one goes on with; empty if there are none.
  std::vector<Places> begun() const;
  /// The seconds of the resumed run, over all intervals.
  double seconds() const;

  /// Call this before the first iteration. Throws if the file cannot be written or is too large for the disk.
  void begin(const std::vector<FrameList>& intervals, Integrator& first);
  /// Loads the interval's state and returns its progress; without a state, the interval is at its beginning.
  IntervalProgress resume(std::size_t interval, Integrator& integrator);
  bool due(int iterations) { return writes() && schedule_.due(iterations); }
  /// Does nothing if no checkpoint is written. Throws WriteError.
  void save(const IntervalProgress& progress, Integrator& integrator);
  const std::filesystem::path& path() const { return path_; }

 private:
  bool writes() const { return !path_.empty(); }
  Messages& messages_;
  bool is_spectral_;
  std::filesystem::path path_;  // empty: none is written
  Interval every_;
  WriteSchedule schedule_;
  CheckpointFile::Render render_;
  std::vector<IntervalState> states_;           // of the last checkpoint
  bool has_changed_ = false;                    // since the resumed one
  bool takes_name_ = false;                     // the file is new and holds no state
  std::size_t kept_ = 0;                        // the first ones, with which this run does not go on
  std::unique_ptr<const CheckpointFile> last_;  // resumed or written; null: none yet
};

}  // namespace dspm
