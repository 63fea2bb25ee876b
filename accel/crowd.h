// The lowest nodes of a tree over a shape of very many primitives, such as the pieces of hair. A tree over these nodes
// is built in a fraction of the time that one over the primitives takes, and hardly worse.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "dspm/accel/bvh.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/shape.h"

namespace dspm {

/// Returns whether the shape has very many primitives, no triangles, and a sample of them lies close together if their
/// numbers are similar.
bool is_crowd(const Shape& shape);

/// Appends nodes of eight primitives each, whose leaves are first_leaf + primitive, and returns their boxes. `box_of`
/// returns the box of a primitive, with margin; any thread may call it.
std::vector<Bounds3> add_crowd(int primitives, std::uint32_t first_leaf, const std::function<Bounds3(int)>& box_of,
                               Bvh::Nodes& nodes);

}  // namespace dspm
