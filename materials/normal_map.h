// Normals of a texture's colours: 2 rgb - 1, whose z is along the shape's own.
#pragma once

#include <memory>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/materials/material.h"
#include "dspm/materials/relief.h"
#include "dspm/textures/texture.h"

namespace dspm {

class NormalMap final : public Relief {
 public:
  /// With `by_v`, y is on the side to which v grows; otherwise it is across the tangent of u.
  NormalMap(TexturePtr<Rgb> picture, float scale, bool by_v);
  Vec3 normal(const SurfacePoint& point, const PlacedShape&, int, Vec2) const override { return leaning(point); }
  /// Returns the normal around the point's shading normal; it may have any length.
  Vec3 leaning(const SurfacePoint& point) const;

 private:
  TexturePtr<Rgb> picture_;
  float scale_;
  bool by_v_;
};

/// Reads the relief of a material's coat; null if it follows the shape.
std::shared_ptr<const NormalMap> read_coat_relief(ParamReader& reader, const MaterialContext& context);

}  // namespace dspm
