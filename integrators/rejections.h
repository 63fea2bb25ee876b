// Contributions that were negative or not finite, by the scene element that produced them. None of them reaches a
// pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class Rejections {
 public:
  struct Entry {
    SceneElement element;
    std::uint64_t count;  // of contributions, in each frame
    Frame frame;          // the first one's
    int pixel;            // the first one's, within the crop; kNoPixel: a photon's
  };
  static constexpr int kNoPixel = -1;

  void add(const SceneElement& element, FrameSet frames, int pixel = kNoPixel) {
    add({element, static_cast<std::uint64_t>(frames.count()), frames.lowest(), pixel});
  }
  Rejections& operator+=(const Rejections& other);

  /// Saves only the count: the elements that the contributions came from have been reported by then.
  void persist(StateStream& state);

  /// The number of contributions of all elements; `entries` lists only the first few.
  std::uint64_t count() const { return count_; }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  void add(const Entry& entry);

  std::uint64_t count_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace dspm
