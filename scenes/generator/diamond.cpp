// The stone of diamond.dsc: diamond.ply, a round brilliant of radius 1 whose girdle lies around the origin, table up (y).
// It is the intersection of the half-spaces below its facets, as a cutter grinds a stone. Angles and sizes are those of an
// ideal cut [Tolkowsky 1919, and the steeper halves of today].
#include <cmath>
#include <vector>

#include "dspm/base/math/double_vec.h"
#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kGirdle = 0.02;    // half its height
constexpr double kTable = 0.56;     // radius of the table's corners
constexpr double kLargest = 4;      // of facets before they are cut
constexpr double kRounding = 1e-9;  // corners on a plane are kept
constexpr double kSameCorner = 1e-6;

/// The stone lies where dot(normal, p) <= offset.
struct Facet {
  DoubleVec3 normal;
  double offset;
};

/// A facet that leans by `degrees` from lying flat, up or down, and passes through a point of that radius and height.
Facet facet(double azimuth, double degrees, bool up, double radius, double height) {
  const double lean = degrees * kDegree, a = azimuth * kDegree;
  const DoubleVec3 normal{std::sin(lean) * std::cos(a), (up ? 1 : -1) * std::cos(lean), std::sin(lean) * std::sin(a)};
  return {normal, std::sin(lean) * radius + normal.y * height};
}

std::vector<Facet> facets() {
  constexpr double kMain = 34.5, kStar = 21.5, kUpperHalf = 40, kPavilion = 40.75, kLowerHalf = 42;
  const double table = kGirdle + (1 - kTable) * std::tan(kMain * kDegree);
  std::vector<Facet> all{{{0, 1, 0}, table}};
  for (int eighth = 0; eighth < 8; ++eighth) {
    const double main = 45 * eighth, star = main + 22.5;
    all.push_back(facet(main, kMain, true, 1, kGirdle));
    all.push_back(facet(star, kStar, true, kTable * std::cos(22.5 * kDegree), table));
    all.push_back(facet(main, kPavilion, false, 1, -kGirdle));
    for (const double half : {main + 11.25, main + 33.75}) {
      all.push_back(facet(half, kUpperHalf, true, 1, kGirdle));
      all.push_back(facet(half, kLowerHalf, false, 1, -kGirdle));
    }
  }
  constexpr int kSides = 64;
  for (int side = 0; side < kSides; ++side) all.push_back(facet(side * 360. / kSides, 90, true, 1, 0));
  return all;
}

/// Returns the part of a polygon on the inner side of the plane.
std::vector<DoubleVec3> cut(const std::vector<DoubleVec3>& polygon, const Facet& plane) {
  std::vector<DoubleVec3> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DoubleVec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double a = dot(plane.normal, from) - plane.offset, b = dot(plane.normal, to) - plane.offset;
    if (a <= kRounding) rest.push_back(from);
    if ((a < -kRounding && b > kRounding) || (a > kRounding && b < -kRounding))
      rest.push_back(from * (b / (b - a)) + to * (a / (a - b)));
  }
  return rest;
}

/// Returns a square in the plane, counterclockwise seen from outside.
std::vector<DoubleVec3> square(const Facet& plane) {
  const DoubleVec3& n = plane.normal;
  DoubleVec3 u = std::abs(n.y) < 0.9 ? cross({0, 1, 0}, n) : cross({1, 0, 0}, n);
  u = u * (kLargest / length(u));
  const DoubleVec3 v = cross(n, u), middle = n * plane.offset;
  return {middle + u + v, middle + u * -1 + v, middle + u * -1 + v * -1, middle + u + v * -1};
}

/// Facets that meet share their corners, so that the stone is closed.
int corner(MeshData& mesh, const DoubleVec3& p) {
  const Vec3 at = narrow(p);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (length2(mesh.vertices[i] - at) < static_cast<float>(kSameCorner * kSameCorner)) return static_cast<int>(i);
  mesh.vertices.push_back(at);
  return static_cast<int>(mesh.vertices.size()) - 1;
}

}  // namespace

void make_diamond(const std::filesystem::path& directory) {
  MeshData mesh;
  const std::vector<Facet> planes = facets();
  for (const Facet& own : planes) {
    std::vector<DoubleVec3> polygon = square(own);
    for (const Facet& other : planes)
      if (&other != &own) polygon = cut(polygon, other);
    std::vector<int> corners;
    for (const DoubleVec3& p : polygon)
      if (const int c = corner(mesh, p); corners.empty() || (c != corners.back() && c != corners.front()))
        corners.push_back(c);
    for (std::size_t i = 2; i < corners.size(); ++i) mesh.faces.push_back({corners[0], corners[i - 1], corners[i]});
  }
  write_ply(directory / "diamond.ply", mesh);
}

}  // namespace dspm
