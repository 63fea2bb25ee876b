// The camera of each frame of the file.
#pragma once

#include <memory>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"
#include "dspm/world/objects/timeline.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns the camera's directive; without one, it is pbrt's usual camera.
const CameraUse& camera_use(const SceneDescription& description, FileFrame frame);
Transform camera_to_world(const SceneDescription& description, FileFrame frame);

/// Makes one camera for each of its states. `film` says all but its place.
Timeline<std::shared_ptr<const Camera>> make_cameras(const SceneDescription& description, const CameraContext& film,
                                                     Diagnostics& diagnostics);

/// Returns the camera of a frame at another moment; null if there can be none.
std::shared_ptr<const Camera> camera_at(const SceneDescription& description, FileFrame frame, Moment moment,
                                        const CameraContext& film);

}  // namespace dspm
