// "point3 portal" of an infinite light: a rectangle that its light must pass.
#pragma once

#include <memory>
#include <optional>

#include "dspm/base/params/params.h"
#include "dspm/lights/background.h"
#include "dspm/lights/environment_map.h"
#include "dspm/lights/light.h"
#include "dspm/lights/rectangle.h"

namespace dspm {

/// Reads four points in the world. Returns nullopt if they are not given, or after an error.
std::optional<Rectangle> read_portal(ParamReader& reader);

/// Through the portal, the camera sees `background` if there is one.
std::unique_ptr<Light> make_portal_light(const LightContext& context, const EnvironmentMap& map, float scale,
                                         const Rectangle& portal, std::optional<Background> background);

}  // namespace dspm
