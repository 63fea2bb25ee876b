// "bool shadowcatcher" of any shape, for any plugin.
#pragma once

#include "dspm/base/params/params.h"

namespace dspm {

inline constexpr const char* kShadowCatcherParam = "shadowcatcher";

/// Returns whether the camera sees, instead of the shape, how other things change its light. Call it before the shape's
/// own factory reads the rest.
inline bool read_shadow_catcher(ParamReader& params) {
  return params.flag(kShadowCatcherParam, false,
                     "true: the image has the shadows that things throw onto it, as alpha, instead of the shape");
}

}  // namespace dspm
