// The time for which each frame is exposed: what moves meanwhile is blurred.
#pragma once

#include <string>
#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"

namespace dspm {

/// The shutter is open from `open` to `close`, in frames after the moment that a frame is named after. A file without
/// frames has pbrt's seconds instead.
struct Shutter {
  double open = 0, close = 0;
  /// Returns whether iterations show other times than the frames' own moments.
  bool delays() const { return open != 0 || close != 0; }
  friend bool operator==(const Shutter&, const Shutter&) = default;
};

/// Returns the shutter of the scene's camera; reports one that cannot be. It stays closed if the camera does not say
/// otherwise. In pbrt's language it is open from 0 to 1 by default, and closed in files with frames, which pbrt has not.
Shutter shutter_of(const SceneDescription& scene, Diagnostics& diagnostics);

/// Returns what has keys, and so may be elsewhere or look different a while after a frame's moment, unless it is said not
/// to blur: "the camera", "3 shapes".
std::vector<std::string> what_moves(const SceneDescription& scene);

/// Returns the scene at a time after each frame's moment.
SceneDescription after(const SceneDescription& scene, double delay);

}  // namespace dspm
