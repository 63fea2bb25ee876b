// The pixels from which learning looks at a scene: few, spread over the whole image, whatever the crop.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/median.h"
#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

inline constexpr std::uint64_t kPilotIteration = std::uint64_t{1} << 40;  // no iteration of the camera has that number

/// A few of the sample's, spread over it: what is decided for all frames alike needs no more.
inline FrameSet few_frames(const Scene& sample) {
  constexpr int kFew = 4;
  const int count = sample.frame_count();
  if (count <= kFew) return sample.frames();
  FrameSet few;
  for (int i = 0; i < kFew; ++i) few |= FrameSet::single(static_cast<Frame>(i * (count - 1) / (kFew - 1)));
  return few;
}

/// As many pixels as what is decided for all of them alike needs, in proportion to what a small picture costs.
inline double few_pixels(const RenderSettings& of) {
  constexpr double kLeast = 256, kMost = 1024, kPixelsAPilot = 16;
  return std::clamp(static_cast<double>(of.width) * of.height / kPixelsAPilot, kLeast, kMost);
}

/// For pilots whose iterations are compared: the difference is then their noise.
inline RenderSettings with_independent_numbers(RenderSettings render) {
  render.independent_numbers = true;
  return render;
}

struct PilotPixels {
  RenderSettings render;  // of the whole image
  int stride;             // between the pixels

  /// Chooses about `count` pixels.
  PilotPixels(const RenderSettings& of, double count)
      : render(of), stride(std::max(1, static_cast<int>(std::sqrt(of.width / count * of.height)))) {
    render.crop = {0, 0, of.width, of.height};
  }

  int columns() const { return (render.width - 1) / stride + 1; }
  int rows() const { return (render.height - 1) / stride + 1; }
  /// Returns the index, among the pilot pixels, of a pixel of the image.
  int index(int pixel) const { return pixel / render.width / stride * columns() + pixel % render.width / stride; }

  std::vector<HitPointTile> trace(const Scene& sample, const HitPointSettings& settings,
                                  std::uint64_t iteration = kPilotIteration) const {
    return trace_hit_points(sample, render, settings, iteration, {}, stride);
  }
};

/// Returns the median radius of the hit points before any shrinking; 0 if there are none.
inline float median_radius(const std::vector<HitPointTile>& tiles) {
  std::vector<float> radii;
  for (const HitPointTile& tile : tiles)
    for (const HitPoint& hit : tile.hit_points) radii.push_back(hit.radius);
  return median(radii);
}

}  // namespace dspm
