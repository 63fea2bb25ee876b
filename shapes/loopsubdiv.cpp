// Shape "loopsubdiv" "integer levels" 3 "integer indices" [...] "point3 P" [...]
//
// The smooth surface of a coarse mesh of triangles, by Loop's subdivision: each level splits every triangle in four and
// moves the vertices. Shading normals are those of the limit surface. Rims follow their own curve.
//
// | parameter | default  | meaning |
// | --------- | -------- | ------- |
// | levels    | 3        | how often triangles are split in four, at most 10 |
// | indices   | required | three indices into P per triangle, from 0 |
// | P         | required | the vertices |
// | scheme    | "loop"   | the only choice |
//
// [Loop 1987, Smooth Subdivision Surfaces Based on Triangles], by CGAL.
#include <CGAL/subdivision_method_3.h>

#include <numbers>
#include <numeric>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/cgal_mesh.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/shapes/shape.h"

namespace dspm {
namespace {

constexpr double kMostTriangles = 5e7;

/// A vertex and its neighbours, in order; on a rim, from one open edge to the other.
struct Neighbourhood {
  DoubleVec3 p;
  std::vector<DoubleVec3> ring;
  bool rim;

  Neighbourhood(const CgalSurface& surface, CgalSurface::Vertex_index v) : p(at(surface, v)) {
    auto start = surface.halfedge(v);
    for (const auto h : surface.halfedges_around_target(start))
      if (surface.is_border(h)) start = h;
    rim = surface.is_border(start);
    if (rim) start = surface.opposite(surface.next(start));
    for (auto h = start; ring.empty() || h != start; h = surface.opposite(surface.next(h)))
      ring.push_back(at(surface, surface.source(h)));
  }

  /// Returns where infinitely many subdivisions move the vertex. [Hoppe et al. 1994, Piecewise Smooth Surface
  /// Reconstruction]
  DoubleVec3 limit() const {
    if (rim) return p * 0.6 + (ring.front() + ring.back()) * 0.2;
    const auto n = static_cast<double>(ring.size());
    const double c = 3 + 2 * std::cos(2 * std::numbers::pi / n), beta = (0.625 - c * c / 64) / n;  // Loop's weight
    const double gamma = 1 / (n + 3 / (8 * beta));
    DoubleVec3 sum = p * (1 - n * gamma);
    for (const DoubleVec3& q : ring) sum = sum + q * gamma;
    return sum;
  }

  /// Returns the normal to two tangents of the limit surface. [ibid., appendix A]
  DoubleVec3 normal() const {
    const std::size_t n = ring.size();
    DoubleVec3 s{0, 0, 0}, t{0, 0, 0};
    if (!rim) {
      for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
        s = s + ring[i] * std::cos(angle), t = t + ring[i] * std::sin(angle);
      }
      return cross(t, s);
    }
    s = ring.back() + ring.front() * -1;
    if (n == 2) {
      t = ring[0] + ring[1] + p * -2;
    } else if (n == 3) {
      t = ring[1] + p * -1;
    } else {
      const double step = std::numbers::pi / static_cast<double>(n - 1);
      t = (ring.front() + ring.back()) * std::sin(step);
      for (std::size_t i = 1; i + 1 < n; ++i)
        t = t + ring[i] * ((2 * std::cos(step) - 2) * std::sin(step * static_cast<double>(i)));
      t = t * -1;
    }
    return cross(s, t);
  }

 private:
  static DoubleVec3 at(const CgalSurface& surface, CgalSurface::Vertex_index v) {
    const auto& q = surface.point(v);
    return {q.x(), q.y(), q.z()};
  }
};

MeshData limit_mesh(const CgalSurface& surface) {
  MeshData mesh;
  for (const auto v : surface.vertices()) {
    const Neighbourhood around(surface, v);
    mesh.vertices.push_back(narrow(around.limit()));
    mesh.normals.push_back(narrow(around.normal()));
  }
  for (const auto f : surface.faces()) {
    std::size_t i = 0;
    Face& face = mesh.faces.emplace_back();
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) face[i++] = static_cast<int>(v.idx());
  }
  return mesh;
}

}  // namespace

std::vector<MadeShape> make_loopsubdiv(ParamReader& reader) {
  const int levels = reader.integer("levels", 3, "", "how often triangles are split in four");
  MeshData coarse = read_triangles(reader);
  reader.choice("scheme", "loop", {"loop"}, "the kind of subdivision");
  const bool repair = read_repair(reader);
  reader.finish();

  const double triangles = std::pow(4, levels) * static_cast<double>(coarse.faces.size());
  if (levels < 0 || levels > 10 || triangles > kMostTriangles) {
    reader.error("levels", "\"levels\" must be from 0 to 10 and give at most 50 million triangles");
    return {};
  }
  if (fault_of(coarse)) return made_mesh(reader, std::move(coarse), repair);
  CgalMesh mesh = to_cgal(coarse.vertices, coarse.faces);
  if (mesh.split) reader.warning("indices", "the mesh is not a single sheet everywhere: it is split where it is not");
  CGAL::Subdivision_method_3::Loop_subdivision(mesh.surface, CGAL::parameters::number_of_iterations(levels));
  return made_mesh(reader, limit_mesh(mesh.surface), repair);
}

}  // namespace dspm
