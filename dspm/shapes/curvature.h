// How a surface is curved, for what its reflections and refractions magnify.
#pragma once

#include "dspm/math/vec.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

/// The mean of the principal curvatures of the shading normals, in 1 / world unit: 1 / r on a sphere. Positive where
/// normals point away from the centre. 0 where the shape does not tell.
float mean_curvature(const PlacedShape& shape, int primitive, Vec2 uv);

}  // namespace dspm
