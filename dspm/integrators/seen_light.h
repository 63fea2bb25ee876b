// Sums of the light that camera paths saw, by pixel and frame.
#pragma once

#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/math/frames.h"
#include "dspm/system/state_stream.h"

namespace dspm {

/// Light that a camera path saw without photons: emission or sampled direct light, as radiance times throughput.
struct SeenLight {
  int pixel;
  FrameSet frames;
  Rgb radiance;
};

class SeenLightSums {
 public:
  SeenLightSums(int pixels, int frames) : frames_(frames), sums_(bytes(pixels, frames) / sizeof(Rgb)) {}
  static std::size_t bytes(int pixels, int frames) {
    return static_cast<std::size_t>(pixels) * static_cast<std::size_t>(frames) * sizeof(Rgb);
  }

  void add(const SeenLight& light) {
    light.frames.for_each([&](Frame f) { sums_[index(light.pixel, f)] += light.radiance; });
  }
  /// Over all iterations, including those whose path saw nothing.
  Rgb mean(int pixel, Frame frame, int iterations) const {
    return iterations == 0 ? Rgb() : sums_[index(pixel, frame)] / static_cast<float>(iterations);
  }
  void persist(StateStream& state) { state.value(sums_); }
  std::size_t bytes() const { return sums_.capacity() * sizeof(Rgb); }

 private:
  std::size_t index(int pixel, Frame frame) const {
    return static_cast<std::size_t>(pixel) * static_cast<std::size_t>(frames_) + static_cast<std::size_t>(frame);
  }

  int frames_;
  std::vector<Rgb> sums_;
};

}  // namespace dspm
