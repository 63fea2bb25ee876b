// Measures how much an animation flickers, apart from what moves steadily.
#pragma once

#include <vector>

#include "dspm/image/image.h"

namespace dspm {

/// x is a pixel's brightness on a screen, in 0..1 of sRGB's scale. In three frames one after the other, the difference
/// of the middle one from the mean of its neighbours does not see steady change. Noise of standard deviation s that is
/// independent from frame to frame leaves s sqrt(3/2), so the difference is divided by that root.
struct Flicker {
  double rms = 0;      // over pixels and frames
  double typical = 0;  // the same for normal noise, but from the median: what moves in a few pixels does not count
  std::vector<float> rms_of_pixel;
};

class FlickerMeter {
 public:
  /// Adds the next frame, as a view shows it. Throws std::runtime_error if its size differs.
  void add(const Image& shown);
  /// Throws std::runtime_error if there are fewer than three frames.
  Flicker result() const;

 private:
  int width_ = 0, height_ = 0, frames_ = 0;
  std::vector<float> last_, before_;  // brightnesses of the last two frames
  std::vector<double> squares_;       // of each pixel
  std::vector<float> magnitudes_;     // of all pixels of every frame; of a part of the pixels if they are many
  std::size_t stride_ = 1;
};

}  // namespace dspm
