#include "scenes/generator/water_body.h"

#include <utility>

namespace dspm {
namespace {

/// The rim of the upper side, counterclockwise seen from above, from a corner on; its first vertex is not repeated.
std::vector<int> rim(int columns, int rows) {
  const int last_column = columns - 1, last_row = rows - 1;
  std::vector<int> list;
  for (int j = 0; j < last_row; ++j) list.push_back(j * columns);
  for (int i = 0; i < last_column; ++i) list.push_back(last_row * columns + i);
  for (int j = last_row; j > 0; --j) list.push_back(j * columns + last_column);
  for (int i = last_column; i > 0; --i) list.push_back(i);
  return list;
}

int add(MeshData& mesh, const Vec3& p, const Vec3& normal) {
  mesh.vertices.push_back(p);
  mesh.normals.push_back(normal);
  return static_cast<int>(mesh.vertices.size()) - 1;
}

/// Adds the sides and the bottom.
void close_below(MeshData& mesh, const std::vector<int>& edge, float bottom) {
  const Vec3 down{0, -1, 0};
  const int middle = add(mesh, {0, bottom, 0}, down);
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const Vec3 p = mesh.vertices[static_cast<std::size_t>(edge[i])];
    const Vec3 q = mesh.vertices[static_cast<std::size_t>(edge[(i + 1) % edge.size()])];
    const Vec3 p_low{p.x, bottom, p.z}, q_low{q.x, bottom, q.z};
    const Vec3 side = normalize(Vec3{p.z - q.z, 0, q.x - p.x});
    const int a = add(mesh, p, side), b = add(mesh, q, side), c = add(mesh, p_low, side), d = add(mesh, q_low, side);
    mesh.faces.push_back({a, c, b});
    mesh.faces.push_back({b, c, d});
    mesh.faces.push_back({middle, add(mesh, q_low, down), add(mesh, p_low, down)});
  }
}

}  // namespace

MeshData water_body(std::vector<Vec3> points, std::vector<Vec3> normals, int columns, float bottom) {
  MeshData mesh;
  mesh.vertices = std::move(points);
  mesh.normals = std::move(normals);
  const int rows = static_cast<int>(mesh.vertices.size()) / columns;
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i, b = a + 1, c = a + columns, d = c + 1;
      mesh.faces.push_back({a, c, b});
      mesh.faces.push_back({b, c, d});
    }
  close_below(mesh, rim(columns, rows), bottom);
  return mesh;
}

}  // namespace dspm
