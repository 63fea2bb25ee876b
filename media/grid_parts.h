// What readers of grid files find, and the grid that it makes.
#pragma once

#include <span>

#include "dspm/base/math/transform.h"
#include "dspm/media/sparse_grid.h"

namespace dspm {

/// A cube of voxels of one value, or a block's values, z fastest.
struct GridPart {
  SparseGrid::Index first;
  int size;  // a multiple of SparseGrid::kSide
  float value;
  const float* values;  // of a block; null: all are `value`
};

/// Throws std::runtime_error if a value is negative or not finite, if a part lies too far away, or if all are too many.
SparseGrid grid_of(std::span<const GridPart> parts, const Transform& to_medium);

}  // namespace dspm
