// Divides the frames of a run into intervals, if not all are rendered together, so that the frames of an interval share
// as much as possible.
#pragma once

#include <span>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/lang/factors.h"

namespace dspm {

/// Frames of the file that are rendered together, ascending.
using FrameList = std::vector<FileFrame>;
using FrameSpan = std::span<const FileFrame>;

/// The frames of an interval's integrator.
struct Places {
  FrameList frames;  // ascending; one that has the places of given-up frames is there several times
  FrameSet given_up = {};

  FrameList going_on() const;
};

class FrameIntervals {
 public:
  /// Never puts frames with different settings of the integrator together. Factors that move paths vary slowest, then
  /// those with the most places: frames that differ only in looks stay together.
  FrameIntervals(const SceneDescription& scene, const FrameList& frames);

  /// Cuts intervals of at most `together` frames, in the order of their first frames. If whole inner products of the
  /// factors fit, an interval holds whole ones; lengths are as equal as that allows.
  std::vector<FrameList> cut(int together) const;
  /// Deals the frames to at most that many machines, each with nearly as many frames as the others: cut as intervals
  /// are, unless that makes more of them than there are machines.
  std::vector<FrameList> deal(int machines) const;

 private:
  std::vector<FrameSpan> blocks(FrameSpan frames, std::size_t factor) const;
  void cut(FrameSpan frames, std::size_t factor, std::size_t together, std::vector<FrameList>& intervals) const;

  const FileFrames& file_;
  std::vector<Factor> factors_;    // slowest first
  std::vector<FrameList> groups_;  // with the same settings of the integrator; sorted
};

}  // namespace dspm
