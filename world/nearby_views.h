// What the cameras of frames see, a frame later and a frame earlier as well.
#pragma once

#include <span>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/lang/description.h"
#include "dspm/world/scene/nearby_moments.h"

namespace dspm {

/// `film` says all of the cameras but their places.
std::vector<NearbyMoments::Views> nearby_views(const SceneDescription& description, std::span<const FileFrame> frames,
                                               const CameraContext& film);

}  // namespace dspm
