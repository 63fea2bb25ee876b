// Area lights whose radiance varies over their shape as a texture says. Lights know no textures, so world implements this
// with one.
#pragma once

#include <memory>

#include "dspm/colour/rgb.h"
#include "dspm/lights/light.h"
#include "dspm/params/params.h"

namespace dspm {

class EmissionPattern {
 public:
  virtual ~EmissionPattern() = default;
  /// A factor to the radiance, not negative.
  virtual Rgb at(const SurfacePoint& point) const = 0;
};

/// An area light "diffuse" with these parameters; null: no pattern.
std::unique_ptr<Light> make_diffuse_area(ParamReader& reader, const LightContext& context,
                                         std::shared_ptr<const EmissionPattern> pattern);

}  // namespace dspm
