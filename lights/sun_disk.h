// "float angle" of a distant light: a sun that is a disk in the sky rather than a point.
#pragma once

#include <memory>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/light.h"

namespace dspm {

/// The narrowest disk whose rim is well above rounding, in degrees.
inline constexpr float kLeastSunAngle = 0.01f;

/// `angle` is the disk's diameter in degrees, from kLeastSunAngle to 180; `irradiance` is that on a surface that faces
/// the light.
std::unique_ptr<Light> make_sun_disk(const LightContext& context, const Vec3& towards_light, const Rgb& irradiance,
                                     float angle);

}  // namespace dspm
