// The rays of a render, to ask them again: of the trees that answered them, or of others.
#pragma once

#include <vector>

#include "bench/measure/run.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"

namespace dspm {

struct AskedRay {
  Ray ray;
  FrameSet frames;
};

struct RecordedRays {
  std::vector<AskedRay> nearest, shadow;  // for partition() and occluded()
};

/// Those of one more iteration of `run`: at most `most` of each kind, the first ones. Does not change the run's scene.
RecordedRays record(const Run& run, int iteration, std::size_t most);

}  // namespace dspm
