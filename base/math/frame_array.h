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
  FrameArray() {}  // the elements stay uninitialised
  T& add(const T& element) { return elements_[count_++] = element; }
  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  void shrink(std::size_t count) { count_ = count; }
  T& operator[](std::size_t i) { return elements_[i]; }
  const T& operator[](std::size_t i) const { return elements_[i]; }
  T* begin() { return elements_.data(); }
  T* end() { return elements_.data() + count_; }
  const T* begin() const { return elements_.data(); }
  const T* end() const { return elements_.data() + count_; }
  operator std::span<const T>() const { return {elements_.data(), count_}; }

 private:
  std::size_t count_ = 0;
  union {
    std::array<T, kMaxFrames> elements_;
  };
};

}  // namespace dspm
