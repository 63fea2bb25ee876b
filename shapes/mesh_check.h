// Finds out whether a mesh is fit for a glass body: closed, with one outside, and without self-intersections.
#pragma once

#include <string>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// The number of times that a fault occurs, and the first place where it does (in the mesh's own space).
struct Fault {
  int count = 0;
  Vec3 where;
};

struct MeshReport {
  Fault open_edges;            // edges of one face only
  int holes = 0;               // rims that they form
  Fault crowded_edges;         // edges of more than two faces
  Fault twisted_edges;         // edges whose two faces disagree about the outside
  bool orientable = true;      // turning faces over can make all agree
  bool outward = true;         // normals point outward; judged only if the mesh is closed and all faces agree
  Fault self_intersections;    // pairs of faces that meet other than in a common edge or vertex
  Fault flat_faces;            // without area
  int duplicate_vertices = 0;  // at the place of an earlier vertex; harmless: texture seams have them

  bool closed() const { return open_edges.count == 0 && crowded_edges.count == 0; }
  /// Returns whether the mesh is fit to be made of glass.
  bool sound() const {
    return closed() && twisted_edges.count == 0 && orientable && outward && self_intersections.count == 0;
  }
};

MeshReport check_mesh(const TriangleMesh& mesh);

/// Describes the faults and where they are, one sentence each; empty for a sound mesh.
std::vector<std::string> describe(const MeshReport& report);

}  // namespace dspm
