// The rays of the measured queries: like a render's, from the camera, then from the surfaces that they meet.
#pragma once

#include <vector>

#include "bench/sections/query_scenes.h"
#include "dspm/accel/accel.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"

namespace dspm {

struct Query {
  Ray ray;
  FrameSet frames;
};

/// One per pixel, for all frames.
std::vector<Query> camera_rays(const QueryScene& scene);
/// One diffuse bounce from everything that `queries` meet, in the frames that meet it.
std::vector<Query> bounced(const QueryScene& scene, const Accel& accel, const std::vector<Query>& queries);

}  // namespace dspm
