// Holds at most one element per frame, on the stack, without the cost of constructing unused ones.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include "dspm/base/math/frames.h"

namespace dspm {

template <class T>
class FrameArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  constexpr FrameArray() {}  // the elements stay uninitialised
  constexpr T& add(const T& element) { return elements_[count_++] = element; }
  constexpr std::size_t size() const { return count_; }
  constexpr bool empty() const { return count_ == 0; }
  constexpr void shrink(std::size_t count) { count_ = count; }
  constexpr T& operator[](std::size_t i) { return elements_[i]; }
  constexpr const T& operator[](std::size_t i) const { return elements_[i]; }
  constexpr T* begin() { return elements_.data(); }
  constexpr T* end() { return elements_.data() + count_; }
  constexpr const T* begin() const { return elements_.data(); }
  constexpr const T* end() const { return elements_.data() + count_; }
  constexpr operator std::span<const T>() const { return {elements_.data(), count_}; }

 private:
  std::size_t count_ = 0;
  union {
    std::array<T, kMaxFrames> elements_;
  };
};

}  // namespace dspm
