// A set of frames of the file, as ranges: most things are there all the time, for a while, or in one frame. A thing
// that moves through thousands of frames has a place in each, so a place must not take room for all of them.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"

namespace dspm {

class FrameRanges {
 public:
  /// Adds a frame; frames must come in ascending order.
  void add(FileFrame f) {
    if (!ranges_.empty() && ranges_.back().end == f.index())
      ++ranges_.back().end;
    else
      ranges_.push_back({f.index(), f.index() + 1});
  }

  bool contains(FileFrame f) const { return any(f, FileFrame(f.index() + 1)); }
  /// Returns whether it holds any frame from `first` to before `end`.
  bool any(FileFrame first, FileFrame end) const {
    const auto range = after(first.index());
    return range != ranges_.end() && std::max(range->first, first.index()) < end.index();
  }
  /// Returns which of `frames`, which ascend, it holds, as bits.
  FrameSet among(std::span<const FileFrame> frames) const {
    FrameSet set;
    if (frames.empty()) return set;
    auto range = after(frames.front().index());
    for (std::size_t j = 0; j < frames.size(); ++j) {
      while (range != ranges_.end() && range->end <= frames[j].index()) ++range;
      if (range == ranges_.end()) break;
      if (range->first <= frames[j].index()) set |= FrameSet::single(static_cast<Frame>(j));
    }
    return set;
  }
  template <class Fn>
  void for_each(Fn&& fn) const {
    for (const Range& range : ranges_)
      for (FileFrame f(range.first); f.index() < range.end; ++f) fn(f);
  }
  std::size_t range_count() const { return ranges_.size(); }

 private:
  struct Range {
    int first, end;
  };
  /// Returns the first range that ends after that frame.
  std::vector<Range>::const_iterator after(int frame) const {
    return std::upper_bound(ranges_.begin(), ranges_.end(), frame, [](int f, const Range& r) { return f < r.end; });
  }

  std::vector<Range> ranges_;
};

}  // namespace dspm
