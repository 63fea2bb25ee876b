// Fewer triangles for the same shape.
#pragma once

#include <functional>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// How long edges should be here, relative to elsewhere.
using Coarseness = std::function<double(const Vec3&)>;

/// A closed mesh of small triangles thinned out to about `triangles`, without normals and texture coordinates.
MeshData simplified(const MeshData& mesh, int triangles, const Coarseness& coarseness);

}  // namespace dspm
