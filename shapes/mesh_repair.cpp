#include "dspm/shapes/mesh_repair.h"

// The exhaustive search is quick for holes as small as ours, and Delaunay triangulations take long to compile.
#define CGAL_HOLE_FILLING_DO_NOT_USE_DT3
#define CGAL_HOLE_FILLING_DO_NOT_USE_CDT2
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/version.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/cgal_mesh.h"
#include "dspm/shapes/mesh_topology.h"
#include "dspm/shapes/triangle.h"

namespace dspm {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr int kMostRimEdges = 100;
constexpr float kLargestHole = 0.25f;  // of the mesh's diagonal
constexpr float kWidestCrack = 1e-6f;  // of the mesh's diagonal

float diagonal(const TriangleMesh& mesh) {
  Bounds3 b;
  for (const Vec3& p : mesh.vertices()) b.add(p);
  return length(b.extent());
}

/// Moves vertices of open edges to earlier ones that lie no farther than `width` away.
void close_cracks(const std::vector<Vec3>& vertices, const std::vector<Face>& faces, float width,
                  std::vector<int>& place) {
  std::set<int> rim;
  for (const Edge& e : edges_of(faces))
    if (e.is_open()) rim.insert({e.low, e.high});
  std::vector<int> order(rim.begin(), rim.end());
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return at(vertices, a).x < at(vertices, b).x; });
  std::vector<int> moved(vertices.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const Vec3 &a = at(vertices, order[i]), &b = at(vertices, order[k]);
      if (b.x - a.x > width) break;
      if (length(b - a) > width) continue;
      const auto [first, second] = std::minmax(order[i], order[k]);
      int& target = moved[static_cast<std::size_t>(second)];
      target = target < 0 ? first : std::min(target, first);
    }
  for (int& p : place)
    while (moved[static_cast<std::size_t>(p)] >= 0) p = moved[static_cast<std::size_t>(p)];
}

/// Returns the indices of the faces that are neither degenerate nor duplicates (in either orientation) of earlier ones.
std::vector<int> distinct_faces(const std::vector<Face>& faces) {
  std::set<Face> seen;
  std::vector<int> kept;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    Face sorted = faces[i];
    std::sort(sorted.begin(), sorted.end());
    if (!has_repeated_vertex(faces[i]) && seen.insert(sorted).second) kept.push_back(static_cast<int>(i));
  }
  return kept;
}

Face corners(const CgalMesh& mesh, CgalSurface::Face_index f) {
  Face result{};
  std::size_t i = 0;
  for (const auto v : mesh.surface.vertices_around_face(mesh.surface.halfedge(f))) result[i++] = mesh.vertices[v.idx()];
  return result;
}

bool is_turned(const Face& now, const Face& before) {
  const std::size_t first = static_cast<std::size_t>(std::find(now.begin(), now.end(), before[0]) - now.begin());
  return now[(first + 1) % 3] != before[1];
}

void fill(CgalSurface& surface, CgalSurface::Halfedge_index rim) {
#if CGAL_VERSION_NR >= 1050600000
  pmp::triangulate_hole(surface, rim);
#else
  std::vector<CgalSurface::Face_index> filling;
  pmp::triangulate_hole(surface, rim, std::back_inserter(filling));
#endif
}

void fill_small_holes(CgalSurface& surface, float largest) {
  std::vector<CgalSurface::Halfedge_index> rims;
  pmp::extract_boundary_cycles(surface, std::back_inserter(rims));
  for (const auto rim : rims) {
    int edges = 0;
    Bounds3 box;
    for (const auto v : surface.vertices_around_face(rim)) ++edges, box.add(to_vec3(surface.point(v)));
    if (edges > kMostRimEdges || length(box.extent()) > largest) continue;
    fill(surface, rim);
  }
}

/// Turns a closed surface outward; in others, each component keeps the side that most of its faces had.
void orient(CgalMesh& mesh, const std::vector<Face>& before) {
  CgalSurface& surface = mesh.surface;
  if (CGAL::is_closed(surface)) return pmp::orient_to_bound_a_volume(surface);
  const auto component = surface.add_property_map<CgalSurface::Face_index, std::size_t>("f:component").first;
  std::vector<int> majority(pmp::connected_components(surface, component));
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const CgalSurface::Face_index f(static_cast<CgalSurface::size_type>(i));
    const bool turned = is_turned(corners(mesh, f), before[static_cast<std::size_t>(mesh.faces[i])]);
    majority[component[f]] += turned ? -1 : 1;
  }
  std::vector<CgalSurface::Face_index> wrong;
  for (const auto f : surface.faces())
    if (majority[component[f]] < 0) wrong.push_back(f);
  pmp::reverse_face_orientations(wrong, surface);
}

/// Takes the plan's faces: the original ones with their own corners (which texture seams may distinguish), turned if
/// needed, and the filling.
void take_faces(const CgalMesh& mesh, const std::vector<Face>& welded, RepairPlan& plan) {
  for (const auto f : mesh.surface.faces()) {
    const Face now = corners(mesh, f);
    if (f.idx() >= mesh.faces.size()) {
      plan.faces.push_back(now);
      ++plan.new_faces;
      continue;
    }
    const auto original = static_cast<std::size_t>(mesh.faces[f.idx()]);
    Face face = plan.before[original];
    if (is_turned(now, welded[original])) std::swap(face[1], face[2]), ++plan.turned_faces;
    plan.faces.push_back(face);
  }
}

DoubleVec3 area_vector_of(const MeshData& mesh, const Face& f) {
  return area_vector(at(mesh.vertices, f[0]), at(mesh.vertices, f[1]), at(mesh.vertices, f[2]));
}

/// Turns normals to the side of the faces around them. If a face would still be turned over by its normals (see
/// TriangleMesh), they are dropped.
void turn_normals(MeshData& mesh) {
  std::vector<DoubleVec3> sides(mesh.vertices.size(), DoubleVec3{0, 0, 0});
  for (const Face& f : mesh.faces)
    for (const int v : f)
      sides[static_cast<std::size_t>(v)] = sides[static_cast<std::size_t>(v)] + area_vector_of(mesh, f);
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (dot(sides[i], widen(mesh.normals[i])) < 0) mesh.normals[i] = -mesh.normals[i];
  for (bool changed = true; changed;) {
    changed = false;
    for (const Face& f : mesh.faces) {
      const Vec3 sum = at(mesh.normals, f[0]) + at(mesh.normals, f[1]) + at(mesh.normals, f[2]);
      if (!(dot(area_vector_of(mesh, f), widen(sum)) < 0)) continue;
      for (const int v : f) mesh.normals[static_cast<std::size_t>(v)] = {};
      changed = true;
    }
  }
}

}  // namespace

RepairPlan plan_repair(const TriangleMesh& mesh) {
  RepairPlan plan;
  plan.before = mesh.faces();
  plan.place = weld(mesh.vertices());
  const float size = diagonal(mesh);
  close_cracks(mesh.vertices(), replace_vertices(plan.before, plan.place), kWidestCrack * size, plan.place);
  for (std::size_t i = 0; i < plan.place.size(); ++i)
    plan.moved_vertices += at(mesh.vertices(), plan.place[i]) != mesh.vertices()[i] ? 1 : 0;

  const std::vector<Face> welded = replace_vertices(plan.before, plan.place);
  const std::vector<int> kept = distinct_faces(welded);
  std::vector<Face> sheets;
  for (const int i : kept) sheets.push_back(welded[static_cast<std::size_t>(i)]);
  CgalMesh cgal = to_cgal(mesh.vertices(), sheets);
  for (int& f : cgal.faces) f = kept[static_cast<std::size_t>(f)];
  plan.dropped_faces = static_cast<int>(welded.size() - cgal.faces.size());

  fill_small_holes(cgal.surface, kLargestHole * size);
  orient(cgal, welded);
  take_faces(cgal, welded, plan);
  for (const Edge& e : edges_of(replace_vertices(plan.faces, plan.place))) plan.open_edges += e.is_open() ? 1 : 0;
  return plan;
}

bool fits(const RepairPlan& plan, const TriangleMesh& mesh) {
  return plan.place.size() == mesh.vertices().size() && plan.before == mesh.faces();
}

TriangleMesh apply(const RepairPlan& plan, const TriangleMesh& mesh) {
  if (!fits(plan, mesh)) throw std::invalid_argument("the repair was planned for a mesh with different faces");
  MeshData mended = mesh.data();
  mended.faces = plan.faces;
  for (std::size_t i = 0; i < plan.place.size(); ++i) mended.vertices[i] = at(mesh.vertices(), plan.place[i]);
  if (!mended.normals.empty()) turn_normals(mended);
  return TriangleMesh(std::move(mended));
}

std::vector<std::string> describe(const RepairPlan& plan) {
  std::vector<std::string> sentences;
  const auto say = [&](int count, const char* one, const char* many) {
    if (count > 0) sentences.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
  };
  say(plan.moved_vertices, "vertex was moved to close a crack", "vertices were moved to close cracks");
  say(plan.dropped_faces, "degenerate or duplicate face was dropped", "degenerate or duplicate faces were dropped");
  say(plan.turned_faces, "face was turned over", "faces were turned over");
  say(plan.new_faces, "face was added to fill holes", "faces were added to fill holes");
  say(plan.open_edges, "open edge remains", "open edges remain");
  return sentences;
}

}  // namespace dspm
