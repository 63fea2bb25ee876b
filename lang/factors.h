// The factors of a file's frames: the moments of the animation, and each axis of variations. Which of them change the
// paths decides which frames are rendered together.
#pragma once

#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/lang/description.h"

namespace dspm {

struct Factor {
  static constexpr int kMoments = -1;
  int axis;          // into SceneDescription::axes, or kMoments
  bool moves_paths;  // geometry, the camera or a light's place differ along it, not only looks and strengths
};

/// Returns the moments first, then the axes in the order of the text.
std::vector<Factor> factors_of(const SceneDescription& scene);

/// Returns the frame's position along the factor.
int place_along(const Factor& factor, const FileFrames& frames, FileFrame frame);

}  // namespace dspm
