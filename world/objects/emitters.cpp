// Finds which shapes emit light, and why.
#include <fmt/format.h>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/params/params.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/objects/param_states.h"

namespace dspm {

/// Returns the shape's own AreaLightSource, else what its material emits.
EmissionUse Geometry::emission(const ShapeUse& use, const Shape& shape, int material) {
  const bool glows = material >= 0 && looks_.emits(material);
  if (use.area_light < 0 && !glows) return {};
  if (shape.turns()) {
    diagnostics_.unsupported(
        use.where, fmt::format("an area light on {} is not supported by dspm", subject_of(use)),
        "it turns to each ray, so it has no area that could emit light; with --lenient, it emits none");
    return {};
  }
  if (use.area_light >= 0) {
    if (glows)
      diagnostics_.warning(
          use.where,
          fmt::format("the AreaLightSource of {} takes the place of what its material emits", subject_of(use)));
    return {&description_.area_lights[static_cast<std::size_t>(use.area_light)]};
  }
  AreaLightUse& light = lights_of_materials_.emplace_back();
  light.type = "diffuse", light.name = looks_.own_name(material);
  light.where = light.type_where = use.where;
  light.params.params = {param_of(ParamType::boolean, "twosided", std::vector{true}, use.where)};
  return {&light, material};
}

}  // namespace dspm
