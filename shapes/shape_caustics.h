// "bool caustics" of any shape, for any plugin.
#pragma once

#include "dspm/base/params/params.h"

namespace dspm {

inline constexpr const char* kShapeCausticsParam = "caustics";

/// Returns whether photons that have met no rough lobe yet go on along the shape's smooth ones. Call it before the
/// shape's own factory reads the rest.
inline bool read_shape_caustics(ParamReader& params) {
  return params.flag(kShapeCausticsParam, true, "false: it throws no caustics; their light is missing");
}

}  // namespace dspm
