// Closed meshes that tests are made with; faces are seen counter-clockwise from outside (right-handed).
#pragma once

#include <map>
#include <utility>

#include "dspm/shapes/triangle_mesh.h"

namespace dspm::test {

/// Two triangles a side, edges of length 2 * half.
inline MeshData box(float half, const Vec3& center) {
  MeshData m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(center + Vec3{i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
  m.faces = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
             {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return m;
}

/// A box of 2 x 2 x 1 from the origin on, without the quarter beyond (1, 1): its side x = 1 lies in a plane that runs
/// through its inside.
inline MeshData corner_piece() {
  MeshData m;
  const float outline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (const float z : {0.f, 1.f})
    for (const auto& [x, y] : outline) m.vertices.push_back({x, y, z});
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    m.faces.insert(m.faces.end(), {{i, next, next + 6}, {i, next + 6, i + 6}});
  }
  for (const auto& [a, b, c] : {Face{0, 1, 2}, Face{0, 2, 3}, Face{0, 3, 5}, Face{3, 4, 5}})
    m.faces.insert(m.faces.end(), {{a, c, b}, {a + 6, b + 6, c + 6}});
  return m;
}

/// An octahedron whose faces are cut in four `levels` times, on a sphere: 8 * 4^levels faces.
inline MeshData icosphere(int levels, float radius, const Vec3& center) {
  MeshData m;
  m.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  m.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, added] = middles.try_emplace(std::minmax(a, b), static_cast<int>(m.vertices.size()));
      if (added)
        m.vertices.push_back(
            normalize(m.vertices[static_cast<std::size_t>(a)] + m.vertices[static_cast<std::size_t>(b)]));
      return it->second;
    };
    std::vector<Face> finer;
    for (const auto& [a, b, c] : m.faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    m.faces = std::move(finer);
  }
  for (Vec3& v : m.vertices) v = center + v * radius;
  return m;
}

/// Signed: below 0 where the mesh is inside out.
inline double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (int i = 0; i < mesh.primitive_count(); ++i)
    sum += double{dot(mesh.vertex(i, 0), cross(mesh.vertex(i, 1), mesh.vertex(i, 2)))} / 6;
  return sum;
}

}  // namespace dspm::test
