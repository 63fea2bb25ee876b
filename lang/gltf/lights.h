// Cameras, and lights of KHR_lights_punctual.
#pragma once

#include "dspm/lang/gltf/statements.h"
#include "dspm/lang/gltf/value.h"

namespace dspm::gltf {

/// Translates extensions/KHR_lights_punctual/lights/i, at the origin, shining along -z. Candela and lux are dspm's W/sr
/// and W/m^2, as nits of emission are its radiance: one unit of light is the same from all lights of a file.
Statement light_of(const Value& light);

struct Sight {
  Statement camera;
  double aspect;  // width over height
};
/// Translates cameras/i. `usual` is the aspect if it has none.
Sight camera_of(const Value& camera, double usual);

}  // namespace dspm::gltf
