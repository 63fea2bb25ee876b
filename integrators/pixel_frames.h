// A value for every pixel in each of the frames that are rendered together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dspm/base/math/frames.h"

namespace dspm {

/// The frames of a pixel lie together. There may be several values a pixel: then `pixel` counts on from the last one.
template <class T>
class PixelFrames {
 public:
  PixelFrames() = default;
  PixelFrames(std::int64_t pixels, int frames)
      : frames_(static_cast<std::size_t>(frames)), values_(bytes(pixels, frames) / sizeof(T)) {}
  static std::size_t bytes(std::int64_t pixels, int frames) {
    return static_cast<std::size_t>(pixels) * static_cast<std::size_t>(frames) * sizeof(T);
  }

  T& at(std::int64_t pixel, Frame frame) { return values_[index(pixel, frame)]; }
  const T& at(std::int64_t pixel, Frame frame) const { return values_[index(pixel, frame)]; }
  bool empty() const { return values_.empty(); }
  std::size_t bytes() const { return values_.capacity() * sizeof(T); }
  /// All values, for StateStream.
  std::vector<T>& values() { return values_; }

 private:
  std::size_t index(std::int64_t pixel, Frame frame) const {
    return static_cast<std::size_t>(pixel) * frames_ + static_cast<std::size_t>(frame);
  }

  std::size_t frames_ = 0;
  std::vector<T> values_;
};

}  // namespace dspm
