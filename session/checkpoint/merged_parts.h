// --merge: the checkpoints of a render's parts, added up in the order of the parts' numbers, so that the bits are the
// same in whatever order the files are named.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "dspm/session/checkpoint/checkpoint_file.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/job/job.h"
#include "dspm/session/messages.h"
#include "dspm/session/observer.h"

namespace dspm {

class MergedParts {
 public:
  /// Throws UsageError, naming the files, if they are not parts of one render, or one is there twice;
  /// std::runtime_error if one is damaged.
  explicit MergedParts(const std::vector<std::string>& files);

  /// The render of the first part.
  const CheckpointFile::Render& render() const { return files_.front()->render(); }
  /// Throws SceneError, for each file, with what has changed since it was written.
  void expect_same(const Job& job);
  /// Says what they hold: missing parts, parts of different length, machines that differ.
  void describe(Messages& messages) const;

  /// The intervals, by their places in the job's file.
  const std::vector<FrameList>& intervals() const { return intervals_; }
  /// Returns the progress of an interval, all parts together.
  IntervalProgress progress(std::size_t interval) const;
  void load(std::size_t interval, Integrator& integrator) const;
  /// Returns whether no iteration is missing before the last one, so that a render can go on from there.
  bool are_whole() const;

 private:
  void expect_one_render() const;
  std::vector<int> missing() const;

  std::vector<std::unique_ptr<const CheckpointFile>> files_;  // by number of the part
  std::vector<FrameList> intervals_;
  bool is_spectral_ = false;
};

}  // namespace dspm
