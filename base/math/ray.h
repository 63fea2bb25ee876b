// A half line, or a segment of it.
#pragma once

#include "dspm/base/math/vec.h"

namespace dspm {

struct Ray {
  Vec3 origin;
  Vec3 direction;           // unit length in the world; of any length in an object's space
  float t_max = kInfinity;  // hits lie in (0, t_max)

  constexpr Vec3 at(float t) const { return origin + direction * t; }
};

}  // namespace dspm
