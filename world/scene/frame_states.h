// An element that may change from frame to frame.
#pragma once

#include <memory>
#include <vector>

#include "dspm/base/math/frames.h"

namespace dspm {

/// An element that may change from frame to frame: an object per distinct state. In frames of no state there is none.
template <class T>
struct FrameStates {
  struct State {
    FrameSet frames;
    std::shared_ptr<const T> object;
  };
  std::vector<State> states;

  /// Returns whether these frames are in more than one state, or the element exists in only some of them.
  bool differs_in(FrameSet frames) const {
    for (const State& s : states)
      if (!(s.frames & frames).empty()) return !s.frames.contains(frames);
    return false;
  }
  /// Calls fn(FrameSet, const T&) for each state that applies in some of `frames`.
  template <class Fn>
  void for_each(FrameSet frames, Fn&& fn) const {
    for (const State& s : states)
      if (const FrameSet common = s.frames & frames; !common.empty()) fn(common, *s.object);
  }
};

}  // namespace dspm
