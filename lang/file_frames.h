// The frames of a file: every variation of its product at every moment of its animation. Without axes there is one
// variation, without Frames one moment.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/math/moments.h"

namespace dspm {

/// A variation of the whole product: a choice along each axis.
struct Combination {
  std::string name;          // "oak-red"; empty if there are no axes
  std::vector<int> choices;  // by axis: which of its variations
};

/// The first moments and the first combinations of a file.
struct FramesPart {
  int moments = 1;
  int combinations = 1;

  int count() const { return moments * combinations; }
};

/// The frames of a file that an earlier run knew; frames have been added since.
struct KnownFrames {
  FramesPart base;                      // all that there was at first, see FileFrames::base
  int moments = 1;                      // of the file then
  std::vector<std::string> names = {};  // of its combinations, those of the base first
  std::vector<FileFrame> rendered;      // by their places then

  FramesPart all() const { return {moments, static_cast<int>(names.size())}; }
};

/// Frames count moment by moment, combination by combination; the frames of the base come first.
class FileFrames {
 public:
  FileFrames() : FileFrames(1, {{}}) {}
  FileFrames(int moments, std::vector<Combination> combinations, std::optional<FramesPart> base = std::nullopt,
             Moment first = Moment())
      : first_moment_(first),
        moments_(moments),
        combinations_(std::move(combinations)),
        base_(base.value_or(FramesPart{moments, static_cast<int>(combinations_.size())})) {}
  /// The frames have the places that they had then; combinations have only names.
  explicit FileFrames(const KnownFrames& known) : FileFrames(known.moments, {}, known.base) {
    for (const std::string& name : known.names) combinations_.push_back({name, {}});
  }

  int count() const { return moments_ * static_cast<int>(combinations_.size()); }
  int moments() const { return moments_; }
  Moment first_moment() const { return first_moment_; }
  Moment last_moment() const { return Moment(first_moment_.frames() + moments_ - 1); }
  const std::vector<Combination>& combinations() const { return combinations_; }
  /// The frames from which sampling derives whatever it derives from the file: all, unless frames were added to a
  /// render.
  const FramesPart& base() const { return base_; }
  bool is_in_base(FileFrame f) const { return f.index() < base_.count(); }

  /// Returns the index of the frame's moment, counted from the first.
  int moment_index(FileFrame f) const { return place(f).moment; }
  /// Returns the moment that the frame shows, see after().
  Moment moment(FileFrame f) const { return Moment(whole_moment(f).frames() + delay_); }
  double delay() const { return delay_; }  // see after()
  /// Returns the moment that the frame is named after.
  Moment whole_moment(FileFrame f) const { return Moment(first_moment_.frames() + moment_index(f)); }
  /// Returns the moment at which the frame shows what blurs, or what does not.
  Moment moment(FileFrame f, bool blurs) const { return blurs ? moment(f) : whole_moment(f); }
  std::size_t combination_of(FileFrame f) const { return static_cast<std::size_t>(place(f).combination); }
  /// Returns the frame with this combination_of() and moment_index().
  FileFrame frame(int combination, int moment) const {
    const int more = moments_ - base_.moments;
    if (combination >= base_.combinations) return FileFrame(combination * moments_ + moment);
    if (moment < base_.moments) return FileFrame(combination * base_.moments + moment);
    return FileFrame(base_.count() + combination * more + moment - base_.moments);
  }
  bool contains(const FramesPart& part, FileFrame f) const {
    return place(f).moment < part.moments && place(f).combination < part.combinations;
  }
  const std::string& variation(FileFrame f) const { return combinations_[combination_of(f)].name; }
  /// Returns "12", "oak-red" or "oak-red 12".
  std::string label(FileFrame f) const {
    const std::string number = std::to_string(whole_moment(f).number());
    return variation(f).empty() ? number : moments_ == 1 ? variation(f) : variation(f) + " " + number;
  }
  /// Returns a file that has only this frame; its moment keeps its number.
  FileFrames only(FileFrame f) const {
    FileFrames one(1, {combinations_[combination_of(f)]});
    one.first_moment_ = whole_moment(f);
    return one;
  }
  /// Returns the same frames, each of which shows a moment so many frames after the one that it is named after.
  FileFrames after(double delay) const {
    FileFrames later = *this;
    later.delay_ = delay;
    return later;
  }
  /// Returns which of the axis's variations frame f has.
  int choice(FileFrame f, std::size_t axis) const { return combinations_[combination_of(f)].choices[axis]; }

 private:
  struct Place {
    int combination, moment;
  };
  Place place(FileFrame f) const {
    const int added = f.index() - base_.count(), more = moments_ - base_.moments, later = more * base_.combinations;
    if (added < 0) return {f.index() / base_.moments, f.index() % base_.moments};
    if (added < later) return {added / more, base_.moments + added % more};
    return {f.index() / moments_, f.index() % moments_};
  }

  Moment first_moment_;
  double delay_ = 0;  // in frames
  int moments_;
  std::vector<Combination> combinations_;
  FramesPart base_;
};

}  // namespace dspm
