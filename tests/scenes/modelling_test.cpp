// What the generator builds its subjects with: sound meshes that come back from their files.
#include "scenes/generator/modelling.h"

#include <gtest/gtest.h>

#include "scenes/generator/mesh_file.h"
#include "shapes/mesh_check.h"
#include "shapes/ply.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace {

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

}  // namespace
}  // namespace dspm
