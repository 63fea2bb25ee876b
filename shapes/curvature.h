// Measures how a surface is curved, for what its reflections and refractions magnify.
#pragma once

#include "dspm/base/math/vec.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

/// Returns the mean of the principal curvatures of the shading normals, in 1 / world unit: 1 / r on a sphere. It is
/// positive where normals point away from the centre, and 0 if the shape does not tell.
float mean_curvature(const PlacedShape& shape, int primitive, Vec2 uv);

}  // namespace dspm
