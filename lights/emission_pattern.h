// Area lights whose radiance varies over their shape as a texture says. Lights know no textures, so world implements
// this with one.
#pragma once

#include <memory>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/lights/light.h"

namespace dspm {

class EmissionPattern {
 public:
  virtual ~EmissionPattern() = default;
  /// Returns a factor to the radiance, which is not negative.
  virtual Rgb at(const SurfacePoint& point) const = 0;
};

/// Makes an area light "diffuse" with these parameters; `pattern` is null if there is none.
std::unique_ptr<Light> make_diffuse_area(ParamReader& reader, const LightContext& context,
                                         std::shared_ptr<const EmissionPattern> pattern);

}  // namespace dspm
