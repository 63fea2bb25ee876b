// Repairs meshes that should be closed bodies: moves vertices that should be one to the same place, fills small holes,
// turns faces outward. The repair is planned once and then applied to every frame of a sequence, so that all frames
// have the same faces.
#pragma once

#include <string>
#include <vector>

#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

struct RepairPlan {
  std::vector<Face> before;  // the faces for which the plan was made
  std::vector<Face> faces;   // those of the repaired mesh, between the same vertices
  std::vector<int> place;    // for every vertex, the one whose place it takes
  int moved_vertices = 0;    // closed cracks
  int dropped_faces = 0;     // degenerate or duplicate
  int turned_faces = 0;
  int new_faces = 0;   // fill holes
  int open_edges = 0;  // remain

  bool changes() const { return moved_vertices + dropped_faces + turned_faces + new_faces > 0; }
};

/// Plans to fill holes of at most 100 edges that are smaller than a quarter of the mesh, and to close cracks up to a
/// millionth of the mesh's diagonal. Self-intersections stay.
RepairPlan plan_repair(const TriangleMesh& mesh);

/// Returns whether the plan was made for a mesh with these faces and this number of vertices.
bool fits(const RepairPlan& plan, const TriangleMesh& mesh);

/// Throws std::invalid_argument unless the plan fits. Vertex normals are turned with their faces.
TriangleMesh apply(const RepairPlan& plan, const TriangleMesh& mesh);

/// Describes the changes of the plan, one sentence each.
std::vector<std::string> describe(const RepairPlan& plan);

}  // namespace dspm
