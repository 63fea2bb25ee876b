#include "dspm/shapes/cgal_mesh.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

#include <array>
#include <numeric>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/mesh_topology.h"

namespace dspm {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// Records which vertices are split.
struct SplitVisitor : pmp::Default_orientation_visitor {
  explicit SplitVisitor(std::vector<int>& origins) : origins_(&origins) {}
  void duplicated_vertex(std::size_t from, std::size_t copy) {
    if (origins_->size() <= copy) origins_->resize(copy + 1);
    (*origins_)[copy] = (*origins_)[from];
  }
  std::vector<int>* origins_;
};

}  // namespace

CgalMesh to_cgal(const std::vector<Vec3>& vertices, const std::vector<Face>& faces) {
  CgalMesh result;
  std::vector<CgalKernel::Point_3> points;
  for (const Vec3& p : vertices) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> polygons;
  std::vector<int> numbers;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (has_repeated_vertex(faces[i])) continue;
    polygons.push_back({static_cast<std::size_t>(faces[i][0]), static_cast<std::size_t>(faces[i][1]),
                        static_cast<std::size_t>(faces[i][2])});
    numbers.push_back(static_cast<int>(i));
  }
  std::vector<int> origins(points.size());
  std::iota(origins.begin(), origins.end(), 0);
  result.split = !pmp::orient_polygon_soup(points, polygons, CGAL::parameters::visitor(SplitVisitor(origins)));

  std::vector<CgalSurface::Vertex_index> handles(points.size(), CgalSurface::null_vertex());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (const std::size_t v : polygons[i]) {
      if (handles[v] != CgalSurface::null_vertex()) continue;
      handles[v] = result.surface.add_vertex(points[v]);
      result.vertices.push_back(origins[v]);
    }
    const auto [a, b, c] = polygons[i];
    if (result.surface.add_face(handles[a], handles[b], handles[c]) != CgalSurface::null_face())
      result.faces.push_back(numbers[i]);
  }
  return result;
}

}  // namespace dspm
