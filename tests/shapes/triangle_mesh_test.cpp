// Triangle meshes: surface points, sides, sampling, and rays that leave a triangle without meeting it again.
#include "dspm/shapes/triangle_mesh.h"

#include <gtest/gtest.h>

#include <array>

#include "dspm/base/math/sampling.h"
#include "tests/shapes/meshes.h"
#include "tests/shapes/placed.h"
#include "tests/shapes/random.h"

namespace dspm {
namespace {

using test::Random;

TEST(TriangleMesh, SurfacePointInterpolates) {
  const TriangleMesh mesh({{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {}, {{0, 0}, {4, 0}, {0, 1}}, {{0, 1, 2}}});
  const SurfacePoint s = mesh.surface_point(0, {0.25f, 0.5f});
  EXPECT_EQ(s.p, (Vec3{0.5f, 1, 0}));
  EXPECT_EQ(s.ng, (Vec3{0, 0, 1}));
  EXPECT_EQ(s.ns, (Vec3{0, 0, 1}));
  EXPECT_EQ(s.uv, (Vec2{1, 0.5f}));
  EXPECT_EQ(s.dpdu, (Vec3{0.5f, 0, 0}));  // u grows by 4 over a length of 2
  EXPECT_EQ(mesh.area(0), 2.f);
}

// At (0.25, 0.5) the corners weigh 1/4, 1/4, 1/2. Without coordinates of their own corners have (0, 0), (1, 0), (1, 1), as
// in pbrt.
TEST(TriangleMesh, EveryCornerHasItsNormalAndCoordinates) {
  const TriangleMesh mesh(
      {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0.6f, 0, 0.8f}, {0, 0.6f, 0.8f}, {-0.8f, 0, 0.6f}}, {}, {{0, 1, 2}}});
  const SurfacePoint s = mesh.surface_point(0, {0.25f, 0.5f});
  EXPECT_LT(length(s.ns - normalize(Vec3{0.15f - 0.4f, 0.15f, 0.2f + 0.2f + 0.3f})), 1e-6f);
  EXPECT_EQ(s.uv, (Vec2{0.75f, 0.5f}));
  EXPECT_LT(length(mesh.surface_point(0, {0, 0}).ns - Vec3{0.6f, 0, 0.8f}), 1e-6f);
}

TEST(TriangleMesh, NormalsTellTheSide) {
  const TriangleMesh mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, -2}, {0, 0, -1}, {1, 0, -1}}, {}, {{0, 1, 2}}});
  const SurfacePoint s = mesh.surface_point(0, {0, 0.5f});
  EXPECT_EQ(s.ng, (Vec3{0, 0, -1}));
  EXPECT_GT(dot(s.ns, s.ng), 0.f);
  EXPECT_NEAR(length(s.ns), 1.f, 1e-6f);
}

TEST(TriangleMesh, FaultsAreNamed) {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(fault_of({corners, {}, {}, {{0, 1, 2}}}), std::nullopt);
  EXPECT_EQ(fault_of({corners, {}, {}, {{0, 1, 3}}}), "face 0 refers to vertex 3, but the mesh has vertices 0 to 2");
  EXPECT_EQ(fault_of({corners, {{0, 0, 1}}, {}, {{0, 1, 2}}}), "1 normals for 3 vertices");
  EXPECT_THROW(TriangleMesh({corners, {}, {}, {{0, 1, -1}}}), std::invalid_argument);
}

// The outside of a mirrored or turned mesh is where the transformed normals of the mesh in its own space point to.
TEST(TriangleMesh, BakingKeepsTheOutside) {
  Random random(4);
  for (const bool with_normals : {false, true}) {
    MeshData data = test::icosphere(1, 1, {});
    if (with_normals) data.normals = data.vertices;
    const TriangleMesh mesh(data);
    for (const double mirror : {-1.0, 1.0}) {
      const Transform t(Matrix4::translate(3, -2, 5) * Matrix4::rotate(33, 1, 2, 3) * Matrix4::scale(mirror, 2, 0.5));
      const TriangleMesh baked = mesh.transformed(t);
      const PlacedShape placed = test::placed(mesh, t);
      for (int i = 0; i < mesh.primitive_count(); ++i) {
        const Vec3 outward = placed.surface_point(i, {0.3f, 0.3f}).ng;
        EXPECT_GT(dot(outward, baked.surface_point(i, {0.3f, 0.3f}).ng), 0.999f);
        EXPECT_GT(dot(outward, baked.vertex(i, 0) - t.point({})), 0.f);
      }
    }
  }
}

// Uniform by area: the means of the barycentrics and of their squares and product over a triangle are 1/3, 1/6, 1/12.
TEST(TriangleMesh, SamplesAreUniform) {
  const TriangleMesh mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}});
  double x = 0, y = 0, xx = 0, xy = 0;
  const int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec2 b = mesh.sample_area(0, {(static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n});
      ASSERT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1.000001f);
      x += b.x, y += b.y, xx += double{b.x} * b.x, xy += double{b.x} * b.y;
    }
  const double count = n * n;
  EXPECT_NEAR(x / count, 1.0 / 3, 1e-4);
  EXPECT_NEAR(y / count, 1.0 / 3, 1e-4);
  EXPECT_NEAR(xx / count, 1.0 / 6, 1e-4);
  EXPECT_NEAR(xy / count, 1.0 / 12, 1e-4);
}

// A point of the triangle, of one of its edges, or a corner.
Vec2 anywhere(Random& random) {
  const float x = random.uniform();
  switch (random.below(5)) {
    case 0: return {x, 0};
    case 1: return {x, 1 - x};
    case 2: return random.below(2) != 0 ? Vec2{1, 0} : Vec2{0, 0};
    default: return uniform_triangle({x, random.uniform()});
  }
}

// A ray that leaves a triangle does not meet it again, however flat it leaves.
TEST(TriangleMesh, SpawnedRaysLeave) {
  Random random(5);
  long again = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const float scale = random.magnitude(-4, 5);
    const Vec3 center = random.direction() * (scale * (random.below(2) != 0 ? random.magnitude(-2, 3) : 0.f));
    const bool flat = random.below(4) == 0;  // in a plane z = const
    std::vector<Vec3> p{random.in_cube(scale), random.in_cube(scale), random.in_cube(scale)};
    for (Vec3& v : p) v = v + center;
    if (flat) p[0].z = p[1].z = p[2].z = random.below(2) != 0 ? 0.f : center.z;
    const TriangleMesh mesh({p, {}, {}, {{0, 1, 2}}});
    const SurfacePoint s = mesh.surface_point(0, anywhere(random));
    if (mesh.intersect(0, s.spawn(test::leaving(s.ng, random)))) ++again;
  }
  EXPECT_EQ(again, 0);
}

// Second coordinates that are (2u + v + 1, 3v): the derivatives are known.
TEST(TriangleMesh, VerticesHaveColoursAndSecondCoordinates) {
  MeshData data{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {}, {{0, 0}, {4, 0}, {0, 1}}, {{0, 1, 2}}};
  EXPECT_EQ(TriangleMesh(MeshData(data)).surface_point(0, {0.25f, 0.5f}).vertices.data, nullptr);
  data.second_uvs = {{1, 0}, {9, 0}, {2, 3}};
  data.colours = {{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0.5f}};
  const TriangleMesh mesh(std::move(data));
  const VertexPlace place = mesh.surface_point(0, {0.25f, 0.5f}).vertices;
  ASSERT_NE(place.data, nullptr);
  EXPECT_EQ(place.data->vertex_colour(place.triangle, place.at), (std::array<float, 4>{0.25f, 0.25f, 0.5f, 0.5f}));
  const auto second = place.data->second_uv(place.triangle, place.at);
  EXPECT_EQ(second.uv, (Vec2{3.5f, 1.5f}));
  EXPECT_EQ(second.by_u, (Vec2{2, 0}));
  EXPECT_EQ(second.by_v, (Vec2{1, 3}));
  EXPECT_THROW(TriangleMesh({{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {}, {}, {{0, 1, 2}}, {}, {{0, 0}}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace dspm
