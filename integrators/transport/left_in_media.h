// The light that media leave of what passes along a segment.
#pragma once

#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/integrators/transport/medium_passage.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns the share of light that is left after the segment, which nothing blocks and which starts in this medium, for
/// each of the frames; frames that leave nothing are not in the result. What is left in a medium that varies is an
/// estimate, see medium_passage.h.
FrameArray<FrameFactor> left_in_media(const Scene& scene, const Ray& segment, int medium, FrameSet frames,
                                      const SegmentNumbers& numbers);

}  // namespace dspm
