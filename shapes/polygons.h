// Polygons of any number of corners, as mesh files hold them, and their triangles.
#pragma once

#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// Polygon i has the corners from ends[i - 1] (0 for the first) to ends[i] - 1.
struct Polygons {
  std::vector<int> corners;  // indices of vertices
  std::vector<std::size_t> ends;

  void add_corner(int vertex) { corners.push_back(vertex); }
  void close() { ends.push_back(corners.size()); }
};

/// Makes fans around a polygon's first corner, or ears if the polygon is not convex. A sequence of frames whose
/// polygons stay convex thus keeps its triangles. Fewer than three corners make no triangle. Corners must be valid
/// indices. Throws std::runtime_error if large polygons are so intricate that it would take long.
std::vector<Face> triangulate(const Polygons& polygons, const std::vector<Vec3>& vertices);

}  // namespace dspm
