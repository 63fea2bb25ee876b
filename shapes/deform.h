// Meshes at times between those of their files: on the way from one file to the next, or as far as the velocities of
// their vertices take them.
#pragma once

#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// Returns whether both have as many vertices, and faces of the same vertices.
bool same_topology(const TriangleMesh& a, const TriangleMesh& b);

/// Returns `own` at a time between two meshes of its topology: t is 0 at `a` and 1 at `b`. Positions are interpolated,
/// and so are normals and tangents where all three have them; everything else is its own.
TriangleMesh between(const TriangleMesh& own, const TriangleMesh& a, const TriangleMesh& b, double t);

/// Returns the mesh after a time in which its vertices have moved by their velocities. Throws std::invalid_argument if
/// they go beyond all bounds.
TriangleMesh moved(const TriangleMesh& mesh, double time);

}  // namespace dspm
