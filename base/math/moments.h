// Frames of the file, and moments of its animation. Neither converts into the other, nor into a frame of the interval
// (frames.h). Inside the program, both count from 0.
#pragma once

#include <cmath>
#include <compare>
#include <cstddef>

namespace dspm {

/// A frame of the file: a variation of the product at a moment of the animation.
class FileFrame {
 public:
  constexpr FileFrame() = default;
  constexpr explicit FileFrame(int index) : index_(index) {}

  constexpr int index() const { return index_; }
  /// The same number, as an index into lists by frame of the file.
  constexpr std::size_t slot() const { return static_cast<std::size_t>(index_); }

  constexpr FileFrame& operator++() {
    ++index_;
    return *this;
  }
  friend constexpr auto operator<=>(FileFrame, FileFrame) = default;

 private:
  int index_ = 0;
};

/// A time of the animation, in frames from the one that texts call 1; between whole frames as well.
class Moment {
 public:
  constexpr Moment() = default;
  constexpr explicit Moment(double frames) : frames_(frames) {}
  /// The whole moment that texts call `number`.
  static constexpr Moment numbered(int number) { return Moment(static_cast<double>(number) - 1); }

  constexpr double frames() const { return frames_; }
  /// Returns the number that texts use; between whole frames, the number of the one before.
  int number() const { return static_cast<int>(std::floor(frames_)) + 1; }

  friend constexpr auto operator<=>(Moment, Moment) = default;

 private:
  double frames_ = 0;
};

/// Returns where `at` lies between two others: 0 at `from`, 1 at `to`.
constexpr double fraction(Moment from, Moment to, Moment at) {
  return (at.frames() - from.frames()) / (to.frames() - from.frames());
}

/// The moments from `first` on and before `end`.
struct MomentInterval {
  Moment first, end;
  constexpr bool contains(Moment moment) const { return first <= moment && moment < end; }
  friend constexpr bool operator==(const MomentInterval&, const MomentInterval&) = default;
};

}  // namespace dspm
