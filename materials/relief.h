// Detail of a surface that is not in its shape: the shading normals of a bump or normal map. The point itself stays.
#pragma once

#include <memory>
#include <string_view>

#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/placed_shape.h"
#include "dspm/textures/plugins.h"

namespace dspm {

class Relief {
 public:
  virtual ~Relief() = default;
  /// The shading normal at a point of a primitive with these parameters, not zero; it may lie below ng.
  virtual Vec3 normal(const SurfacePoint& point, const PlacedShape& shape, int primitive, Vec2 uv) const = 0;

  /// Returns the point with that normal, bent back to the half space of ng if it is below.
  SurfacePoint bent(const SurfacePoint& point, const PlacedShape& shape, int primitive, Vec2 uv) const;
};

/// Returns whether a material of that type has a relief of its own: a mix shows those of its materials.
inline bool has_relief(std::string_view material) { return material != "mix" && material != "interface"; }

/// Reads "normalmap" and "displacement" of any material, for any plugin; null if it has neither. Call it before the
/// material's own factory reads the rest.
std::shared_ptr<const Relief> read_relief(ParamReader& reader, const TextureContext& context);

}  // namespace dspm
