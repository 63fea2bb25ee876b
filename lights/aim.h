// "from" and "to": where a light is, and where it shines.
#pragma once

#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"

namespace dspm {

struct Aim {
  Vec3 from, along;  // light space; `along` is not normalised, and not zero
};

/// Reports an error if both are the same point; the defaults then apply.
Aim read_aim(ParamReader& reader);

}  // namespace dspm
