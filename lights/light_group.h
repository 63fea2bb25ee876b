// The group that a scene puts a light into, for any plugin:
//   LightSource "spot" "string group" "key"
// Integrators can give the light of each group as an output of its own.
#pragma once

#include <string>

#include "dspm/base/params/params.h"

namespace dspm {

inline constexpr const char* kGroupParam = "group";
/// The name for lights that have no group of their own.
inline constexpr const char* kOtherLights = "other";

/// Reads the group. Call it before the light's own factory reads the rest.
std::string read_light_group(ParamReader& params);

}  // namespace dspm
