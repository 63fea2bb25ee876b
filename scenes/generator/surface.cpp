#include "scenes/generator/surface.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

/// By central differences. At a pole, where one slope vanishes, slightly next to it.
Vec3 normal_at(const Surface& surface, float u, float v) {
  constexpr float kStep = 1e-3f;
  const Vec3 du = surface(u + kStep, v) - surface(u - kStep, v), dv = surface(u, v + kStep) - surface(u, v - kStep);
  const Vec3 n = cross(du, dv);
  if (length(n) > 1e-3f * (length2(du) + length2(dv))) return normalize(n);
  return normal_at(surface, u, v < 0.5f ? v + 5 * kStep : v - 5 * kStep);
}

}  // namespace

MeshData patch(int columns, int rows, const Surface& surface, const TextureMap& texture) {
  MeshData mesh;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const float u = static_cast<float>(column) / static_cast<float>(columns);
      const float v = static_cast<float>(row) / static_cast<float>(rows);
      mesh.vertices.push_back(surface(u, v));
      mesh.normals.push_back(normal_at(surface, u, v));
      mesh.uvs.push_back(texture(u, v));
    }
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int i = row * (columns + 1) + column, above = i + columns + 1;
      mesh.faces.push_back({i, i + 1, above + 1});
      mesh.faces.push_back({i, above + 1, above});
    }
  return mesh;
}

}  // namespace dspm
