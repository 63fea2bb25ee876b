// Frames and sets of frames: the central idea of dspm. Inside the program, frames count from 0.
#pragma once

#include <bit>
#include <cstdint>

namespace dspm {

/// One state of the scene: a moment of an animation or a variation of a product.
using Frame = int;

/// The maximum number of frames rendered together, one bit each.
inline constexpr int kMaxFrames = 64;

/// Contiguous frames first .. last - 1.
struct FrameInterval {
  Frame first = 0, last = 0;
  int count() const { return last - first; }
  bool contains(Frame f) const { return first <= f && f < last; }
  friend bool operator==(const FrameInterval&, const FrameInterval&) = default;
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
  constexpr int count() const { return std::popcount(bits_); }
  constexpr bool contains(Frame f) const { return (bits_ >> f & 1) != 0; }
  constexpr bool contains(FrameSet other) const { return (other.bits_ & ~bits_) == 0; }
  constexpr Frame lowest() const { return std::countr_zero(bits_); }
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
  void for_each(Fn&& fn) const {
    for (std::uint64_t rest = bits_; rest != 0; rest &= rest - 1) fn(static_cast<Frame>(std::countr_zero(rest)));
  }

 private:
  std::uint64_t bits_ = 0;
};

}  // namespace dspm
