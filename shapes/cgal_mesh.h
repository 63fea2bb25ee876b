// A triangle mesh in CGAL's form. Only the files that work with CGAL include this.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalSurface = CGAL::Surface_mesh<CgalKernel::Point_3>;

/// CGAL's surfaces are manifold and consistently oriented; if ours is not, faces are turned over and vertices split. A
/// component in which all faces agree keeps its sides.
struct CgalMesh {
  CgalSurface surface;
  std::vector<int> vertices;  // of each of the surface's vertices: its number in the mesh
  std::vector<int> faces;     // of each of the surface's faces: its number among the faces given
  bool split = false;         // around some edges or vertices, the faces do not form one sheet
};

/// Faces with a repeated vertex and vertices that no face uses are left out.
CgalMesh to_cgal(const std::vector<Vec3>& vertices, const std::vector<Face>& faces);

inline const Vec3& at(const std::vector<Vec3>& vertices, int i) { return vertices[static_cast<std::size_t>(i)]; }

inline Vec3 to_vec3(const CgalKernel::Point_3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

}  // namespace dspm
