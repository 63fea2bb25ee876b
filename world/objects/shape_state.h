// What a Shape directive says of a shape at a moment, while the shutter may be open.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/only_text.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/file_frames.h"
#include "dspm/world/objects/params_at.h"

namespace dspm {

struct ShapeState {
  ParamList params;
  double delay = 0;  // since the moment that the frame is named after, in frames
  /// The mesh files of the frames around that time, one by one from the frame's own; empty if they are all its own.
  std::vector<std::string> files = {};

  bool is_same(const ShapeState& other) const {
    return delay == other.delay && files == other.files && params.same_values(other.params);
  }
};

/// Returns the state at one of the moments of `frames`.
inline ShapeState shape_state(const ParamList& params, const FileFrames& frames, Moment moment) {
  ShapeState state{params_at(params, frames, moment), frames.delay()};
  const std::string* const own = only_text(state.params.find("filename"));
  if (own == nullptr || state.delay == 0 || !params.is_keyed()) return state;
  const double whole = std::round(moment.frames() - state.delay), step = state.delay < 0 ? -1 : 1;
  bool differs = false;
  for (double at = step; std::abs(at) < std::abs(state.delay) + 1; at += step) {
    const ParamList there = params.at(Moment(whole + at));
    const std::string* const name = only_text(there.find("filename"));
    state.files.push_back(name != nullptr ? *name : *own);
    differs = differs || state.files.back() != *own;
  }
  if (!differs) state.files.clear();
  return state;
}

}  // namespace dspm
