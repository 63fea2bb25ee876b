// Bounds the place where a part of a shape lies in the world.
#pragma once

#include "dspm/base/math/vec.h"
#include "dspm/shapes/placed_shape.h"

namespace dspm {

/// Returns the box in the world around a box in the shape's own space, with a margin for rounding. A box within another
/// one stays within it, to the bit: sums and products of numbers that are rounded keep their order.
Bounds3 bounds_of(const PlacedShape& placed, const Bounds3& own);

}  // namespace dspm
