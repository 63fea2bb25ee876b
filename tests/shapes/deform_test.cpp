// Meshes on the way from one to the other, and by the velocities of their vertices.
#include "dspm/shapes/deform.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace dspm::test {
namespace deform_test {

TriangleMesh triangle(const Vec3& first, const Vec3& normal, std::vector<Vec2> uvs = {}) {
  return TriangleMesh(MeshData{{first, {1, 0, 0}, {0, 1, 0}}, {normal, normal, normal}, std::move(uvs), {{0, 1, 2}}});
}

TEST(Deform, PositionsAndNormalsAreBetweenThoseOfTheFiles) {
  const TriangleMesh own = triangle({0, 0, 0}, {0, 0, 1}, {{0, 0}, {1, 0}, {0, 1}}),
                     next = triangle({-4, 0, 2}, {1, 0, 0}, {{9, 9}, {8, 9}, {9, 8}});
  const TriangleMesh half = between(own, own, next, 0.5);
  EXPECT_EQ(half.vertices()[0], (Vec3{-2, 0, 1}));
  EXPECT_EQ(half.vertices()[1], (Vec3{1, 0, 0}));
  EXPECT_NEAR(half.normals()[0].x, std::sqrt(0.5f), 1e-6f);
  EXPECT_NEAR(half.normals()[0].z, std::sqrt(0.5f), 1e-6f);
  EXPECT_EQ(half.uvs(), own.uvs());
  EXPECT_EQ(between(own, own, next, 0).vertices(), own.vertices());
  EXPECT_EQ(between(own, own, next, 1).vertices(), next.vertices());
}

TEST(Deform, NormalsStayIfTheOtherFileHasNone) {
  const TriangleMesh own = triangle({0, 0, 0}, {0, 0, 1});
  const TriangleMesh bare(MeshData{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, {}, {}, {{0, 1, 2}}});
  EXPECT_EQ(between(own, own, bare, 0.5).normals(), own.normals());
}

// Normals to the other side turn a face over.
TEST(Deform, TopologyIsThatOfVerticesAndFaces) {
  const TriangleMesh mesh = triangle({0, 0, 0}, {0, 0, 1});
  EXPECT_TRUE(same_topology(mesh, triangle({-4, 0, 2}, {1, 0, 0})));
  EXPECT_TRUE(same_topology(mesh, triangle({0, 0, 0}, {0, 0, -1})));
  const std::vector<Vec3> four{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const auto of = [](std::vector<Vec3> vertices, std::vector<Face> faces) {
    return TriangleMesh(MeshData{std::move(vertices), {}, {}, std::move(faces)});
  };
  EXPECT_FALSE(same_topology(mesh, of(four, {{0, 1, 2}})));
  EXPECT_FALSE(same_topology(of(four, {{0, 1, 2}}), of(four, {{0, 1, 3}})));
  EXPECT_FALSE(same_topology(of(four, {{0, 1, 2}}), of(four, {{1, 2, 0}})));
  EXPECT_FALSE(same_topology(of(four, {{0, 1, 2}}), of(four, {{0, 1, 2}, {1, 3, 2}})));
}

TEST(Deform, VerticesMoveByTheirVelocities) {
  MeshData data = triangle({0, 0, 0}, {0, 0, 1}).data();
  data.velocities = {{2, 0, 0}, {0, 4, 0}, {0, 0, 0}};
  const TriangleMesh later = moved(TriangleMesh(data), 0.5);
  EXPECT_EQ(later.vertices(), (std::vector<Vec3>{{1, 0, 0}, {1, 2, 0}, {0, 1, 0}}));
  EXPECT_TRUE(later.data().velocities.empty());
  EXPECT_THROW(moved(TriangleMesh(data), 1e39), std::invalid_argument);
  data.velocities.pop_back();
  EXPECT_THROW(TriangleMesh{data}, std::invalid_argument);
  data.velocities.push_back({0, std::numeric_limits<float>::infinity(), 0});
  EXPECT_THROW(TriangleMesh{data}, std::invalid_argument);
}

}  // namespace deform_test
}  // namespace dspm::test
