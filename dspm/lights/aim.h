// "from" and "to": where a light shines.
#pragma once

#include "dspm/math/vec.h"
#include "dspm/params/params.h"

namespace dspm {

struct Aim {
  Vec3 from, along;  // light space; `along` is not normalised, and not zero
};

/// Where both are one point: an error, and the defaults hold.
Aim read_aim(ParamReader& reader);

}  // namespace dspm
