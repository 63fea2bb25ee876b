#include "scenes/generator/simplify.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1050600000
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_count_stop_predicate.h>
#else
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#endif

#include <optional>

#include "dspm/shapes/cgal_mesh.h"

namespace dspm {
namespace {

namespace simplification = CGAL::Surface_mesh_simplification;

#if CGAL_VERSION_NR >= 1050600000
using EdgeCount = simplification::Edge_count_stop_predicate<CgalSurface>;
#else
using EdgeCount = simplification::Count_stop_predicate<CgalSurface>;
#endif
#if CGAL_VERSION_NR >= 1060000000
using Cost = std::optional<double>;
#else
using Cost = boost::optional<double>;
#endif

/// The shortest edge collapses first, so that triangles become roughly equilateral.
struct LengthCost {
  const Coarseness& coarseness;

  template <class Profile, class Placement>
  Cost operator()(const Profile& profile, const Placement&) const {
    const auto a = profile.p0(), b = profile.p1();
    const double wanted = coarseness(to_vec3(CGAL::midpoint(a, b)));
    return CGAL::squared_distance(a, b) / (wanted * wanted);
  }
};

}  // namespace

MeshData simplified(const MeshData& mesh, int triangles, const Coarseness& coarseness) {
  CgalSurface surface = to_cgal(mesh.vertices, mesh.faces).surface;
  const auto edges = static_cast<std::size_t>(triangles) * 3 / 2;
  using Middle = simplification::Midpoint_placement<CgalSurface>;
  simplification::edge_collapse(
      surface, EdgeCount(edges),
      CGAL::parameters::get_cost(LengthCost{coarseness})
          .get_placement(simplification::Bounded_normal_change_placement<Middle>(Middle())));  // no face turns over
  surface.collect_garbage();

  MeshData result;
  for (const auto v : surface.vertices()) result.vertices.push_back(to_vec3(surface.point(v)));
  for (const auto f : surface.faces()) {
    const auto h = surface.halfedge(f);
    result.faces.push_back({static_cast<int>(surface.source(h)), static_cast<int>(surface.target(h)),
                            static_cast<int>(surface.target(surface.next(h)))});
  }
  return result;
}

}  // namespace dspm
