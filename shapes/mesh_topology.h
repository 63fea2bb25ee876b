// Finds out how the faces of a mesh are connected, by the places of their vertices: texture seams do not separate a
// surface.
#pragma once

#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// Returns, for every vertex, the first vertex at exactly its place (itself if it is the first).
std::vector<int> weld(const std::vector<Vec3>& vertices);

/// Returns the faces with every vertex replaced by `place[vertex]`.
std::vector<Face> replace_vertices(std::vector<Face> faces, const std::vector<int>& place);

inline bool has_repeated_vertex(const Face& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; }

/// An edge, and the number of faces along it in either direction: from its lower to its higher vertex, or back.
struct Edge {
  int low, high;
  int forward = 0, backward = 0;

  int faces() const { return forward + backward; }
  bool is_open() const { return faces() == 1; }
  bool is_crowded() const { return faces() > 2; }
  bool is_twisted() const { return faces() == 2 && forward != 1; }
};

/// Returns all edges of the faces that have three different vertices, ascending.
std::vector<Edge> edges_of(const std::vector<Face>& faces);

/// Returns the number of connected rims that the open edges among `edges` form.
int count_holes(const std::vector<Edge>& edges);

}  // namespace dspm
