// An image with less noise. Every pixel becomes a weighted mean of the neighbours that differ from it by no more than
// their noise and that show the same surface, but moves no farther from itself than its own noise explains. [Buades et
// al. 2005; Rousselle et al. 2012, 2013]
#pragma once

#include "dspm/image/image.h"

namespace dspm {

/// A frame's images as an integrator gives them; all have the same size.
struct NoisyImage {
  Image radiance;
  Image variance;  // of radiance, by component
  // Of the surfaces that the camera sees; only r of depth. Where there is none: no normal, and a depth beyond
  // kNoSurface.
  Image albedo, normal, depth;
};
inline constexpr float kNoSurface = 1e9f;

/// The images that it holds for each pixel while it runs, its result included.
inline constexpr int kImagesOfJointFilter = 6;

/// Filters the image. A pixel without variance stays as it is. The bits are the same with any number of threads.
Image joint_filtered(const NoisyImage& image);

}  // namespace dspm
