#include "scenes/generator/isosurface.h"

#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>

#include <cmath>

namespace dspm {
namespace {

using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
using Kernel = Triangulation::Geom_traits;

Vec3 to_vec3(const Kernel::Point_3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

}  // namespace

// [Boissonnat, Oudot 2005, Provably Good Sampling and Meshing of Surfaces], by CGAL.
MeshData isosurface(const Field& field, const Vec3& middle, float radius, const MeshingGoal& goal) {
  const auto function = [&field](const Kernel::Point_3& p) { return field(to_vec3(p)); };
  const double r = radius;
  const CGAL::Implicit_surface_3<Kernel, decltype(function)> surface(
      function, Kernel::Sphere_3({middle.x, middle.y, middle.z}, r * r), 1e-6);
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(goal.angle, goal.size, goal.distance);
  Triangulation triangulation;
  CGAL::Complex_2_in_triangulation_3<Triangulation> complex(triangulation);
  CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_tag());
  CGAL::Surface_mesh<Kernel::Point_3> found;
  CGAL::facets_in_complex_2_to_triangle_mesh(complex, found);

  MeshData mesh;
  for (const auto v : found.vertices()) mesh.vertices.push_back(to_vec3(found.point(v)));
  for (const auto f : found.faces()) {
    const auto h = found.halfedge(f);
    mesh.faces.push_back({static_cast<int>(found.source(h)), static_cast<int>(found.target(h)),
                          static_cast<int>(found.target(found.next(h)))});
  }
  return mesh;
}

Vec3 gradient(const Field& field, const Vec3& p) {
  constexpr float kStep = 1e-3f;
  Vec3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 low = p, high = p;
    low[axis] -= kStep, high[axis] += kStep;
    slope[axis] = static_cast<float>(field(high) - field(low));
  }
  return normalize(slope);
}

}  // namespace dspm
