// The frames of a file: every variation of its product at every moment of its animation. Without axes there is one
// variation, without Frames one moment.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dspm/math/frames.h"

namespace dspm {

/// A variation of the whole product: a choice along each axis.
struct Combination {
  std::string name;          // "oak-red"; empty if there are no axes
  std::vector<int> choices;  // by axis: which of its variations
};

/// Frame f is moment f % moments(), counted from the first, of combination f / moments().
class FileFrames {
 public:
  FileFrames() : FileFrames(1, {{}}) {}
  FileFrames(int moments, std::vector<Combination> combinations)
      : moments_(moments), combinations_(std::move(combinations)) {}

  int count() const { return moments_ * static_cast<int>(combinations_.size()); }
  int moments() const { return moments_; }
  const std::vector<Combination>& combinations() const { return combinations_; }

  /// Which of the moments, counted from the first.
  int moment_index(FileFrame f) const { return f.index() % moments_; }
  Moment moment(FileFrame f) const { return Moment(first_moment_.frames() + moment_index(f)); }
  std::size_t combination_of(FileFrame f) const { return static_cast<std::size_t>(f.index() / moments_); }
  const std::string& variation(FileFrame f) const { return combinations_[combination_of(f)].name; }
  /// "12", "oak-red" or "oak-red 12".
  std::string label(FileFrame f) const {
    const std::string number = std::to_string(moment(f).number());
    return variation(f).empty() ? number : moments_ == 1 ? variation(f) : variation(f) + " " + number;
  }
  /// As if the file had only that frame; its moment keeps its number.
  FileFrames only(FileFrame f) const {
    FileFrames one(1, {combinations_[combination_of(f)]});
    one.first_moment_ = moment(f);
    return one;
  }
  /// Which of the axis's variations frame f has.
  int choice(FileFrame f, std::size_t axis) const { return combinations_[combination_of(f)].choices[axis]; }

 private:
  Moment first_moment_;
  int moments_;
  std::vector<Combination> combinations_;
};

}  // namespace dspm
