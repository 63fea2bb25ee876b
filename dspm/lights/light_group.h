// The group that a scene puts a light into, whatever its plugin:
//   LightSource "spot" "string group" "key"
// Integrators can give the light of each group as an output of its own.
#pragma once

#include <string>

#include "dspm/params/params.h"

namespace dspm {

inline constexpr const char* kGroupParam = "group";
/// Of lights that have no group of their own.
inline constexpr const char* kOtherLights = "other";

/// To be called before the light's own factory reads the rest.
std::string read_light_group(ParamReader& params);

}  // namespace dspm
