// The lowest nodes of a tree over a shape of very many primitives, such as the pieces of hair. A tree over these nodes is
// built in a fraction of the time that one over the primitives takes, and hardly worse.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "dspm/accel/bvh.h"
#include "dspm/math/vec.h"

namespace dspm {

/// With fewer primitives, little time is to be won.
inline constexpr int kCrowd = 1 << 14;

/// Appends nodes of eight primitives each, whose leaves are first_leaf + primitive, and returns their boxes. Neighbours are
/// found among primitives of similar numbers; if those are far apart, it appends nothing. `box_of`: of a primitive, with
/// margin; called by any thread.
std::vector<Bounds3> add_crowd(int primitives, std::uint32_t first_leaf, const std::function<Bounds3(int)>& box_of,
                               Bvh::Nodes& nodes);

}  // namespace dspm
