#include "dspm/shapes/mesh_check.h"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/cgal_mesh.h"
#include "dspm/shapes/mesh_topology.h"
#include "dspm/shapes/triangle.h"

namespace dspm {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

Vec3 center(const std::vector<Vec3>& vertices, const Face& f) {
  return (at(vertices, f[0]) + at(vertices, f[1]) + at(vertices, f[2])) / 3;
}

bool is_flat(const std::vector<Vec3>& vertices, const Face& f) {
  const DoubleVec3 n = area_vector(at(vertices, f[0]), at(vertices, f[1]), at(vertices, f[2]));
  return !(dot(n, n) > 0);
}

void count(Fault& fault, const Vec3& where) {
  if (fault.count++ == 0) fault.where = where;
}

// The lowest face is reported, because CGAL's order of pairs is unspecified.
Fault self_intersections(const CgalMesh& mesh, const std::vector<Vec3>& vertices, const std::vector<Face>& faces) {
  const auto number = [&](CgalSurface::Face_index f) { return mesh.faces[f.idx()]; };
  std::vector<CgalSurface::Face_index> solid;
  for (const auto f : mesh.surface.faces())
    if (!is_flat(vertices, faces[static_cast<std::size_t>(number(f))])) solid.push_back(f);
  std::vector<std::pair<CgalSurface::Face_index, CgalSurface::Face_index>> pairs;
  pmp::self_intersections<CGAL::Sequential_tag>(solid, mesh.surface, std::back_inserter(pairs));

  Fault fault;
  fault.count = static_cast<int>(pairs.size());
  int lowest = static_cast<int>(faces.size());
  for (const auto& [f, g] : pairs) lowest = std::min({lowest, number(f), number(g)});
  if (fault.count > 0) fault.where = center(vertices, faces[static_cast<std::size_t>(lowest)]);
  return fault;
}

}  // namespace

MeshReport check_mesh(const TriangleMesh& mesh) {
  MeshReport report;
  const std::vector<Vec3>& vertices = mesh.vertices();
  const std::vector<int> place = weld(vertices);
  for (std::size_t i = 0; i < place.size(); ++i) report.duplicate_vertices += place[i] != static_cast<int>(i) ? 1 : 0;
  const std::vector<Face> faces = replace_vertices(mesh.faces(), place);
  for (const Face& f : faces)
    if (is_flat(vertices, f)) count(report.flat_faces, center(vertices, f));

  const std::vector<Edge> edges = edges_of(faces);
  for (const Edge& e : edges) {
    const Vec3 middle = (at(vertices, e.low) + at(vertices, e.high)) / 2;
    if (e.is_open()) count(report.open_edges, middle);
    if (e.is_crowded()) count(report.crowded_edges, middle);
    if (e.is_twisted()) count(report.twisted_edges, middle);
  }
  report.holes = count_holes(edges);

  const CgalMesh cgal = to_cgal(vertices, faces);
  // If turning faces over is not enough, CGAL's surface is cut open.
  int rim = 0;
  for (const auto e : cgal.surface.edges()) rim += cgal.surface.is_border(e) ? 1 : 0;
  report.orientable = report.crowded_edges.count > 0 || rim == report.open_edges.count;
  if (rim == 0 && report.twisted_edges.count == 0)
    report.outward = pmp::is_outward_oriented(cgal.surface) && pmp::does_bound_a_volume(cgal.surface);
  report.self_intersections = self_intersections(cgal, vertices, faces);
  return report;
}

std::vector<std::string> describe(const MeshReport& report) {
  std::vector<std::string> sentences;
  const auto say = [&](const Fault& fault, const std::string& what, const char* one, const char* many) {
    const Vec3& p = fault.where;
    const bool single = fault.count == 1;
    if (fault.count > 0)
      sentences.push_back(fmt::format("{}: {} {}, {}near ({:.4g}, {:.4g}, {:.4g})", what, fault.count,
                                      single ? one : many, single ? "" : "the first ", p.x, p.y, p.z));
  };
  say(report.open_edges, fmt::format("it is not closed but has {} hole{}", report.holes, report.holes == 1 ? "" : "s"),
      "open edge", "open edges");
  say(report.crowded_edges, "more than two faces share an edge", "such edge", "such edges");
  say(report.twisted_edges, "neighbouring faces disagree about the outside", "edge", "edges");
  if (!report.orientable) sentences.push_back("it has only one side, like a Moebius strip");
  if (!report.outward) sentences.push_back("it is inside out, or some of its components are");
  say(report.self_intersections, "it intersects itself", "pair of faces", "pairs of faces");
  return sentences;
}

}  // namespace dspm
