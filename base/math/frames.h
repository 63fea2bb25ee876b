// Frames, moments and sets of frames: the central idea of dspm. A frame of the file, a frame of the interval and a
// moment do not convert into one another. Inside the program, frames count from 0.
#pragma once

#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "dspm/base/math/bits.h"

namespace dspm {

/// A frame of the interval that is rendered together: a place in FrameSet.
using Frame = int;

/// The maximum number of frames rendered together, one bit each.
inline constexpr int kMaxFrames = 64;

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

/// The frames in which a path, a photon or a hit point exists, relative to the interval that is rendered together.
class FrameSet {
 public:
  constexpr FrameSet() = default;
  constexpr explicit FrameSet(std::uint64_t bits) : bits_(bits) {}
  static constexpr FrameSet single(Frame f) { return FrameSet(std::uint64_t{1} << f); }
  static constexpr FrameSet first(int count) {
    return FrameSet(count >= kMaxFrames ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1);
  }

  constexpr bool empty() const { return bits_ == 0; }
  constexpr int count() const { return count_of_bits(bits_); }
  constexpr bool contains(Frame f) const { return (bits_ >> f & 1) != 0; }
  constexpr bool contains(FrameSet other) const { return (other.bits_ & ~bits_) == 0; }
  constexpr Frame lowest() const { return lowest_bit(bits_); }
  constexpr std::uint64_t bits() const { return bits_; }

  constexpr FrameSet& operator|=(FrameSet o) {
    bits_ |= o.bits_;
    return *this;
  }
  constexpr FrameSet& operator&=(FrameSet o) {
    bits_ &= o.bits_;
    return *this;
  }
  constexpr FrameSet& operator-=(FrameSet o) {
    bits_ &= ~o.bits_;
    return *this;
  }
  friend constexpr FrameSet operator|(FrameSet a, FrameSet b) { return a |= b; }
  friend constexpr FrameSet operator&(FrameSet a, FrameSet b) { return a &= b; }
  friend constexpr FrameSet operator-(FrameSet a, FrameSet b) { return a -= b; }
  friend constexpr bool operator==(FrameSet, FrameSet) = default;

  /// Calls fn(Frame) for every frame, in ascending order.
  template <class Fn>
  constexpr void for_each(Fn&& fn) const {
    for (std::uint64_t rest = bits_; rest != 0; rest &= rest - 1) fn(lowest_bit(rest));
  }

 private:
  std::uint64_t bits_ = 0;
};

}  // namespace dspm
