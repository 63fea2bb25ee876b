#include "dspm/shapes/displace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "dspm/base/math/double_vec.h"
#include "dspm/shapes/triangle.h"

namespace dspm {
namespace {

constexpr std::size_t kMostTriangles = 20'000'000;

template <class T>
const T& at(const std::vector<T>& values, int index) {
  return values[static_cast<std::size_t>(index)];
}

/// Numbers the places: vertices at one place with one normal (or none) move together, whatever their texture
/// coordinates.
std::vector<int> places_of(const MeshData& mesh) {
  std::map<std::array<float, 6>, int> known;
  std::vector<int> places;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 &p = mesh.vertices[i], n = mesh.normals.empty() ? Vec3{} : mesh.normals[i];
    places.push_back(known.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z}, static_cast<int>(known.size())).first->second);
  }
  return places;
}

/// Returns the mean normals of the faces around each place, weighted by their areas.
std::vector<Vec3> normals_of(const MeshData& mesh, const std::vector<int>& places) {
  std::vector<DoubleVec3> sums(mesh.vertices.size(), DoubleVec3{0, 0, 0});
  for (const Face& f : mesh.faces) {
    const DoubleVec3 n = area_vector(at(mesh.vertices, f[0]), at(mesh.vertices, f[1]), at(mesh.vertices, f[2]));
    for (const int v : f) {
      DoubleVec3& sum = sums[static_cast<std::size_t>(at(places, v))];
      sum = sum + n;
    }
  }
  std::vector<Vec3> normals;
  for (const int place : places) {
    const DoubleVec3& n = at(sums, place);
    const double size = length(n);
    normals.push_back(size > 0 ? narrow(n * (1 / size)) : Vec3{});
  }
  return normals;
}

void refuse_many(double triangles) {
  if (triangles > double{kMostTriangles})
    throw std::runtime_error("a displaced mesh would have more than 20 million triangles");
}

/// Returns a lower bound on how many triangles with edges up to `longest` make up one with these edges.
double least_parts(double a, double b, double c, double longest) {
  const double s = 0.5 * (a + b + c), squared = s * (s - a) * (s - b) * (s - c);  // of the area [Heron]
  const double of_part = 0.25 * std::sqrt(3) * longest * longest;
  return std::max({1.0, std::max(a, std::max(b, c)) / longest, std::sqrt(std::max(squared, 0.0)) / of_part});
}

/// Splits the longest edges of faces in half.
class Splitter {
 public:
  Splitter(MeshData& mesh, const Displacing& how) : mesh_(mesh), how_(how) {}

  void split_all() {
    double least = 0;
    for (const Face& f : mesh_.faces) least += least_parts(length(f, 0), length(f, 1), length(f, 2), how_.longest);
    refuse_many(least);
    std::vector<Face> waiting = std::move(mesh_.faces);
    mesh_.faces = {};
    while (!waiting.empty()) {
      const Face f = waiting.back();
      waiting.pop_back();
      if (const int corner = longest_edge(f); corner < 0) {
        mesh_.faces.push_back(f);
      } else {
        const auto at_corner = [&](int c) { return f[static_cast<std::size_t>((corner + c) % 3)]; };
        const int middle = middle_of(at_corner(0), at_corner(1));
        waiting.push_back({middle, at_corner(1), at_corner(2)});
        waiting.push_back({at_corner(0), middle, at_corner(2)});
      }
      refuse_many(static_cast<double>(mesh_.faces.size() + waiting.size()));
    }
  }

 private:
  float length(const Face& f, std::size_t corner) const {
    return how_.length(at(mesh_.vertices, f[corner]), at(mesh_.vertices, f[(corner + 1) % 3]));
  }

  /// Returns the corner at which the longest edge starts; -1 if all edges are short enough.
  int longest_edge(const Face& f) const {
    int corner = -1;
    float longest = how_.longest;
    for (int c = 0; c < 3; ++c)
      if (const float edge = length(f, static_cast<std::size_t>(c)); edge > longest) longest = edge, corner = c;
    return corner;
  }

  int middle_of(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const std::uint64_t edge = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high);
    const auto [known, is_new] = middles_.try_emplace(edge, static_cast<int>(mesh_.vertices.size()));
    if (is_new) {
      mesh_.vertices.push_back(0.5f * (at(mesh_.vertices, low) + at(mesh_.vertices, high)));
      mesh_.uvs.push_back((at(mesh_.uvs, low) + at(mesh_.uvs, high)) * 0.5f);
      if (!mesh_.second_uvs.empty())
        mesh_.second_uvs.push_back((at(mesh_.second_uvs, low) + at(mesh_.second_uvs, high)) * 0.5f);
      if (!mesh_.colours.empty()) {
        std::array<float, 4> mean = at(mesh_.colours, low);
        for (std::size_t c = 0; c < 4; ++c) mean[c] = 0.5f * (mean[c] + at(mesh_.colours, high)[c]);
        mesh_.colours.push_back(mean);
      }
      const Vec3 n = at(mesh_.normals, low) + at(mesh_.normals, high);
      mesh_.normals.push_back(length2(n) > 0 ? normalize(n) : at(mesh_.normals, low));
    }
    return known->second;
  }

  MeshData& mesh_;
  const Displacing& how_;
  std::unordered_map<std::uint64_t, int> middles_;
};

}  // namespace

MeshData displaced(const TriangleMesh& mesh, const Displacing& how) {
  MeshData result = mesh.data();
  result.tangents.clear(), result.turned.clear();
  if (result.uvs.empty()) throw std::runtime_error("a mesh to be displaced must have texture coordinates");
  if (result.normals.empty()) result.normals = normals_of(result, places_of(result));
  Splitter(result, how).split_all();
  const std::vector<int> places = places_of(result);
  for (std::size_t i = 0; i < result.vertices.size(); ++i)
    result.vertices[i] = result.vertices[i] + result.normals[i] * how.distance(result.vertices[i], result.uvs[i]);
  result.normals = normals_of(result, places);
  return result;
}

}  // namespace dspm
