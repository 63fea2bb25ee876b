// Interfaces that contradict each other about the medium between two shapes, or between the camera and what it sees.
#pragma once

#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// What parts media in a scene of one frame, and where the file says so.
struct MediaBorders {
  const Scene& scene;
  std::vector<const WorldShape*> surfaces;    // by Scene::shapes
  std::vector<const WorldShape*> boundaries;  // by MediumBoundaries::shapes
  const SceneDescription& description;
  int width, height;  // of the film
};

/// Follows rays through the scene, and warns of pairs that mostly contradict each other.
void warn_of_contradictions(const MediaBorders& borders, Diagnostics& diagnostics);

}  // namespace dspm
