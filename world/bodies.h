// Finds what paths need to know of the bodies of a scene.
#pragma once

#include "dspm/world/scene/scene.h"

namespace dspm {

/// Sets which materials bound bodies, if these absorb light or differ in priority.
void find_bodies(Scene& scene);
/// Sets the bodies that the camera lies in. Everything else in the scene must be finished.
void find_bodies_around_camera(Scene& scene);

}  // namespace dspm
