// Nothing to complain about.
#pragma once

#include "dspm/base/math/vec.h"
#include "dspm/shapes/shape.h"

namespace dspm {

class Scene;
void look_at(const Scene& scene, const Vec3& from);

}  // namespace dspm
