// Displaced meshes: edges that are short enough, no cracks, and the distances that were asked for.
#include "dspm/shapes/displace.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "tests/shapes/random.h"

namespace dspm {
namespace {

/// A cube of 12 triangles whose faces have corners of their own, as texture coordinates demand.
TriangleMesh cube() {
  MeshData data;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.f, 1.f}) {
      const int first = static_cast<int>(data.vertices.size());
      for (int corner = 0; corner < 4; ++corner) {
        Vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = corner % 2 == 0 ? -side : side;
        p[(axis + 2) % 3] = corner / 2 == 0 ? -1.f : 1.f;
        data.vertices.push_back(p);
        data.uvs.push_back({static_cast<float>(corner % 2), static_cast<float>(corner / 2)});
      }
      data.faces.push_back({first, first + 1, first + 3});
      data.faces.push_back({first, first + 3, first + 2});
    }
  return TriangleMesh(std::move(data));
}

float distance(const Vec3& a, const Vec3& b) { return length(a - b); }

TEST(Displace, EdgesAreSplitUntilTheyAreShort) {
  const MeshData made = displaced(cube(), {distance, 0.3f, [](const Vec3&, Vec2) { return 0.f; }});
  float longest = 0;
  double area = 0;
  const TriangleMesh mesh{MeshData(made)};
  for (int f = 0; f < mesh.primitive_count(); ++f) {
    area += static_cast<double>(mesh.area(f));
    for (int c = 0; c < 3; ++c) longest = std::max(longest, distance(mesh.vertex(f, c), mesh.vertex(f, (c + 1) % 3)));
  }
  EXPECT_LE(longest, 0.3f);
  EXPECT_GT(longest, 0.15f);
  EXPECT_NEAR(area, 24, 1e-4);
}

/// Edges by the places of their ends, and how often faces have them.
std::map<std::array<float, 6>, int> uses_of_edges(const MeshData& mesh) {
  std::map<std::array<float, 6>, int> edges;
  for (const Face& f : mesh.faces)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 a = mesh.vertices[static_cast<std::size_t>(f[c])];
      const Vec3 b = mesh.vertices[static_cast<std::size_t>(f[(c + 1) % 3])];
      const std::array<float, 6> there{a.x, a.y, a.z, b.x, b.y, b.z}, back{b.x, b.y, b.z, a.x, a.y, a.z};
      ++edges[std::min(there, back)];
    }
  return edges;
}

// Along the cube's edges, vertices of two or three faces lie at one place: they move together.
TEST(Displace, AClosedMeshStaysClosed) {
  const auto bumps = [](const Vec3& p, Vec2) { return 0.2f * std::sin(5 * p.x) * std::cos(4 * p.y + p.z); };
  const MeshData made = displaced(cube(), {distance, 0.17f, bumps});
  EXPECT_GT(made.faces.size(), 1000u);
  for (const auto& [edge, count] : uses_of_edges(made)) EXPECT_EQ(count, 2);
}

TEST(Displace, VerticesMoveAlongTheirNormals) {
  MeshData square{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  const MeshData made =
      displaced(TriangleMesh(std::move(square)), {distance, 0.1f, [](const Vec3&, Vec2 uv) { return 0.5f * uv.x; }});
  for (std::size_t i = 0; i < made.vertices.size(); ++i) {
    EXPECT_NEAR(made.vertices[i].z, 0.5f * made.vertices[i].x, 1e-6f);
    EXPECT_NEAR(length(normalize(made.normals[i]) - normalize({-0.5f, 0, 1})), 0, 1e-5f);
  }
}

TEST(Displace, TooManyTrianglesAreAnError) {
  EXPECT_THROW(displaced(cube(), {distance, 1e-5f, [](const Vec3&, Vec2) { return 0.f; }}), std::runtime_error);
  MeshData bare{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {}, {}, {{0, 1, 2}}};
  EXPECT_THROW(displaced(TriangleMesh(std::move(bare)), {distance, 1, [](const Vec3&, Vec2) { return 0.f; }}),
               std::runtime_error);
}

// Red is x and the second coordinates are (y, x): so they stay, wherever edges are split.
TEST(Displace, ColoursAndSecondCoordinatesAreInterpolated) {
  MeshData square{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  for (const Vec3& p : square.vertices) {
    square.second_uvs.push_back({p.y, p.x});
    square.colours.push_back({p.x, 0, 0, p.y});
  }
  const MeshData made =
      displaced(TriangleMesh(std::move(square)), {distance, 0.1f, [](const Vec3&, Vec2) { return 0.5f; }});
  ASSERT_EQ(made.colours.size(), made.vertices.size());
  ASSERT_EQ(made.second_uvs.size(), made.vertices.size());
  EXPECT_GT(made.vertices.size(), 100u);
  for (std::size_t i = 0; i < made.vertices.size(); ++i) {
    const Vec3 p = made.vertices[i];
    EXPECT_EQ(made.colours[i], (std::array<float, 4>{p.x, 0, 0, p.y}));
    EXPECT_EQ(made.second_uvs[i], (Vec2{p.y, p.x}));
  }
}

}  // namespace
}  // namespace dspm
