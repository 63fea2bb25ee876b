// Chooses which of a file's frames are rendered: --variation and --frames.
#pragma once

#include <optional>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"
#include "dspm/session/job/choices.h"

namespace dspm {

/// The places of frames that an earlier run knew, in the file as it is now.
class MovedFrames {
 public:
  MovedFrames(const KnownFrames& known, const FileFrames& now);

  /// The present number of each earlier combination; nullopt if it is not there any more.
  const std::vector<std::optional<int>>& combinations() const { return combinations_; }
  int combination_then(FileFrame frame) const { return static_cast<int>(then_.combination_of(frame)); }
  std::optional<FileFrame> at(FileFrame frame) const;
  /// Returns the frames that are still there, ascending.
  std::vector<FileFrame> of(const std::vector<FileFrame>& frames) const;

 private:
  const FileFrames& now_;
  const FileFrames then_;
  std::vector<std::optional<int>> combinations_;
};

/// With only_new, but all chosen frames were rendered already.
class NothingNew : public UsageError {
  using UsageError::UsageError;
};

/// Returns the chosen frames, ascending. Throws UsageError if an option chooses none, with the names that may have been
/// meant.
std::vector<FileFrame> chosen_frames(const SceneDescription& description, const Choices& choices);

}  // namespace dspm
