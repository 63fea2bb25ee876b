// Displacement: a mesh whose edges are split until they are short, and whose vertices are then moved along their
// normals.
#pragma once

#include <functional>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// The settings of a mesh's displacement.
struct Displacing {
  std::function<float(const Vec3& a, const Vec3& b)> length;  // of an edge
  float longest = 1;                                          // edges are split until none is longer
  std::function<float(const Vec3& p, Vec2 uv)> distance;      // along the normal
};

/// Returns the displaced mesh. Faces that share an edge split it alike, so no cracks arise where none were. Vertices
/// move along the mesh's normals or, if it has none, the mean of the faces' around them; the result has those of its
/// own faces. Throws std::runtime_error if it would have more than 20 million triangles.
MeshData displaced(const TriangleMesh& mesh, const Displacing& how);

}  // namespace dspm
