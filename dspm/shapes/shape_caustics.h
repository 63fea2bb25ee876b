// "bool caustics" of any shape, whatever its plugin.
#pragma once

#include "dspm/params/params.h"

namespace dspm {

inline constexpr const char* kShapeCausticsParam = "caustics";

/// Whether photons that have met no rough lobe yet go on along the shape's smooth ones. To be called before the shape's
/// own factory reads the rest.
inline bool read_shape_caustics(ParamReader& params) {
  return params.flag(kShapeCausticsParam, true, "false: it throws no caustics; their light is missing");
}

}  // namespace dspm
