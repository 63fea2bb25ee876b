// How messages say which frame of a file they mean.
#pragma once

#include <fmt/format.h>

#include <string>

#include "dspm/base/math/moments.h"
#include "dspm/lang/file_frames.h"

namespace dspm {

/// Returns ` in frame 12`, ` in variation "oak"` or ` in frame 12 of variation "oak"`.
inline std::string in_frame(const FileFrames& frames, FileFrame f) {
  const std::string& variation = frames.variation(f);
  if (!variation.empty() && frames.moments() == 1) return fmt::format(" in variation \"{}\"", variation);
  const std::string frame = fmt::format(" in frame {}", frames.whole_moment(f).number());
  return variation.empty() ? frame : fmt::format("{} of variation \"{}\"", frame, variation);
}

}  // namespace dspm
