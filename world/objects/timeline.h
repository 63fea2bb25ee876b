// The distinct states of a thing, and its state in each frame of the file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/lang/file_frames.h"

namespace dspm {

template <class State>
struct Timeline {
  std::vector<State> states;
  std::vector<int> state_of;  // by frame of the file; -1: absent

  /// Indexes states by a number that equal ones have in common (see likeness.h), so that few are compared.
  using Index = std::unordered_map<std::uint64_t, std::vector<int>>;
  static std::uint64_t unknown(const State&) { return 0; }  // compares all

  /// Collects the states that `at(frame)` (an optional State) takes over `frames` frames, each once, in order of first
  /// use.
  template <class At, class Same, class Likeness = decltype(unknown)>
  static Timeline of(int frames, At&& at, Same&& same, Likeness&& likeness = unknown) {
    Timeline line;
    Index index;
    line.state_of.assign(static_cast<std::size_t>(frames), -1);
    for (FileFrame f(0); f.index() < frames; ++f)
      if (std::optional<State> state = at(f))
        line.state_of[f.slot()] = line.place(std::move(*state), index, same, likeness);
    return line;
  }

  /// Collects the states of a thing that is there in `present` (by frame of the file) and whose state, `at(moment)`,
  /// depends on the moment alone.
  template <class At, class Same, class Likeness = decltype(unknown)>
  static Timeline of_moments(const FileFrames& frames, const std::vector<bool>& present, At&& at, Same&& same,
                             Likeness&& likeness = unknown) {
    constexpr int kUnknown = -1;
    Timeline line;
    Index index;
    line.state_of.assign(present.size(), -1);
    std::vector<int> of_moment(static_cast<std::size_t>(frames.moments()), kUnknown);
    for (FileFrame f(0); f.index() < frames.count(); ++f) {
      if (!present[f.slot()]) continue;
      int& state = of_moment[static_cast<std::size_t>(frames.moment_index(f))];
      if (state == kUnknown) state = line.place(at(frames.moment(f)), index, same, likeness);
      line.state_of[f.slot()] = state;
    }
    return line;
  }

  /// Returns the index of that state, which is added if it is new.
  template <class Same, class Likeness>
  int place(State state, Index& index, Same&& same, Likeness&& likeness) {
    std::vector<int>& alike = index[likeness(state)];
    // Newest first: a thing that changes from frame to frame seldom returns to an old state.
    for (std::size_t i = alike.size(); i-- > 0;)
      if (same(states[static_cast<std::size_t>(alike[i])], state)) return alike[i];
    alike.push_back(static_cast<int>(states.size()));
    states.push_back(std::move(state));
    return alike.back();
  }

  /// Returns how many states the first frames have; these states come first.
  int states_of_first(int frames) const {
    int count = 0;
    for (FileFrame f(0); f.index() < frames; ++f) count = std::max(count, at(f) + 1);
    return count;
  }

  int at(FileFrame f) const { return state_of[f.slot()]; }
};

/// Returns the frames of `rendered` (frames of the file) in which `line` is in that state, as bits of the rendered
/// ones.
template <class State>
FrameSet frames_in_state(const Timeline<State>& line, int state, const std::vector<FileFrame>& rendered) {
  FrameSet set;
  for (std::size_t j = 0; j < rendered.size(); ++j)
    if (line.at(rendered[j]) == state) set |= FrameSet::single(static_cast<Frame>(j));
  return set;
}

}  // namespace dspm
