// What paths need know of the bodies of a scene.
#pragma once

#include "dspm/scene/scene.h"

namespace dspm {

/// Sets which materials bound bodies, if these absorb light or differ in priority.
void find_bodies(Scene& scene);
/// Sets the bodies that the camera lies in. The scene is finished but for these.
void find_bodies_around_camera(Scene& scene);

}  // namespace dspm
