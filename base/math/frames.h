// Frames and sets of frames: the central idea of dspm. Inside the program, frames count from 0.
#pragma once

#include <cstdint>

#include "dspm/base/math/bits.h"

namespace dspm {

/// A frame of the interval that is rendered together: a place in FrameSet.
using Frame = int;

/// The maximum number of frames rendered together, one bit each.
inline constexpr int kMaxFrames = 64;

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
