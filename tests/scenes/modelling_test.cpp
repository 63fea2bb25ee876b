// What the generator builds its subjects with: sound meshes that come back from their files.
#include "scenes/generator/modelling.h"

#include <gtest/gtest.h>

#include "dspm/shapes/mesh_check.h"
#include "dspm/shapes/ply.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/noise.h"
#include "scenes/generator/surface.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace modelling_test {

TEST(Lathe, MakesSoundBodies) {
  for (const auto& profile :
       {std::vector<Vec2>{{0, -1}, {1, 0}, {0, 1}}, std::vector<Vec2>{{0, 0}, {2, 0}, {1, 1}, {1.5f, 2}, {0, 2}}}) {
    const MeshReport report = check_mesh(TriangleMesh(lathe(profile, 12)));
    EXPECT_TRUE(report.sound()) << describe(report).front();
  }
}

TEST(Append, KeepsTheOutsideOfMirroredParts) {
  const MeshData body = lathe({{0, -1}, {1, 0}, {0, 1}}, 8);
  MeshData both = body;
  append(both, body, Transform(Matrix4::translate(3, 0, 0) * Matrix4::scale(-1, 2, 1)));
  EXPECT_EQ(both.vertices.size(), 2 * body.vertices.size());
  EXPECT_TRUE(check_mesh(TriangleMesh(both)).sound());
}

/// Of every triangle that is not degenerate, as at a pole: the side that its normals tell is that of its corners'
/// order.
void expect_faces_on_the_side_of_normals(const MeshData& mesh) {
  ASSERT_EQ(fault_of(mesh), std::nullopt);
  for (const Face& face : mesh.faces) {
    const auto corner = [&](int i) { return static_cast<std::size_t>(face[static_cast<std::size_t>(i)]); };
    const Vec3 a = mesh.vertices[corner(0)], b = mesh.vertices[corner(1)], c = mesh.vertices[corner(2)];
    const Vec3 n = cross(b - a, c - a);
    if (length2(n) <= 1e-9f * length2(b - a)) continue;
    for (int i = 0; i < 3; ++i) ASSERT_GT(dot(normalize(n), mesh.normals[corner(i)]), 0);
  }
}

TEST(Limb, HasItsNormalsOutside) {
  const MeshData mesh = limb({{{0, 0, 0}, .2f, .1f}, {{0, 1, .3f}, .3f, .2f}, {{0, 2, 0}, .1f, .1f}}, {1, 0, 0}, 2.5f);
  expect_faces_on_the_side_of_normals(mesh);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)  // the limb's path lies in the plane x = 0
    if (std::abs(mesh.vertices[i].x) > 0.05f) {
      EXPECT_GT(mesh.vertices[i].x * mesh.normals[i].x, 0);
    }
}

TEST(Cushion, IsAsLargeAsAskedFor) {
  const MeshData mesh = cushion({3, 2, .5f, .2f, .4f, .05f});
  expect_faces_on_the_side_of_normals(mesh);
  Bounds3 bounds;
  for (const Vec3& p : mesh.vertices) bounds.add(p);
  EXPECT_NEAR(bounds.high.x, 3, .1f);
  EXPECT_NEAR(bounds.high.z, 2, .1f);
  EXPECT_NEAR(bounds.high.y, .7f, 1e-3f);
  EXPECT_NEAR(bounds.low.y, -.7f, 1e-3f);
}

TEST(Noise, RepeatsAndStaysWithinBounds) {
  for (int i = 0; i < 1000; ++i) {
    const float x = static_cast<float>(i % 32) / 32, y = static_cast<float>(i / 32) / 32;
    const float value = layered_noise(3, x, y, 5, 7, 3);
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
    EXPECT_EQ(value, layered_noise(3, x + 1, y - 2, 5, 7, 3));
  }
}

TEST(WritePly, IsReadBack) {
  const test::TemporaryDirectory directory;
  for (const int sides : {5, 40000}) {  // indices of two and of four bytes
    MeshData mesh = lathe({{0, 0}, {1, 1}, {1, 2}, {0, 3}}, sides);
    mesh.normals = mesh.vertices;
    for (const Vec3& p : mesh.vertices) mesh.uvs.push_back({p.x, p.z});
    write_ply(directory / "m.ply", mesh);
    const MeshData read = read_ply(test::contents(directory / "m.ply"));
    EXPECT_EQ(read.vertices, mesh.vertices);
    EXPECT_EQ(read.normals, mesh.normals);
    EXPECT_EQ(read.uvs, mesh.uvs);
    EXPECT_EQ(read.faces, mesh.faces);
  }
}

}  // namespace modelling_test
}  // namespace dspm
