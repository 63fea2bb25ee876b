// A basin's water as a closed body: its upper side as given, its sides and its bottom hidden in the stone around it.
#pragma once

#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// Points and normals of the upper side, row by row, `columns` points a row; x grows along a row, z from row to row.
/// The sides go down to `bottom`, which must be inside the stone, as the outermost points must be.
MeshData water_body(std::vector<Vec3> points, std::vector<Vec3> normals, int columns, float bottom);

}  // namespace dspm
