// Where the shapes of a scene are a frame later and a frame earlier, as keys and sequences say.
#pragma once

#include <span>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/lang/description.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/scene/nearby_moments.h"

namespace dspm {

inline Moment moment_of(Moment moment, Nearby when) {
  return Moment(moment.frames() + (when == Nearby::later ? 1 : -1));
}

/// Returns the changes for NearbyMoments. `shapes` are those of the scene of `frames`, in its order; they are in the
/// geometry, which outlives the result.
std::vector<NearbyMoments::Change> nearby_changes(const SceneDescription& description, const Geometry& geometry,
                                                  const std::vector<const WorldShape*>& shapes,
                                                  std::span<const FileFrame> frames);

/// Returns the frames, and those of the same variations a moment later and earlier, as far as the file has them.
std::vector<FileFrame> with_nearby(const FileFrames& file, std::span<const FileFrame> frames);

}  // namespace dspm
