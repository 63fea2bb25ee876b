// Loop subdivision: counts, limits that are known, rims.
#include <gtest/gtest.h>

#include "dspm/shapes/mesh_check.h"
#include "dspm/shapes/triangle_mesh.h"
#include "tests/shapes/making.h"
#include "tests/shapes/meshes.h"

namespace dspm {
namespace {

const TriangleMesh* subdivided(const MeshData& mesh, int levels, std::vector<MadeShape>& keep,
                               Diagnostics& diagnostics) {
  std::vector<float> points;
  for (const Vec3& p : mesh.vertices) points.insert(points.end(), {p.x, p.y, p.z});
  std::vector<int> indices;
  for (const Face& f : mesh.faces) indices.insert(indices.end(), f.begin(), f.end());
  keep = test::make_shapes(
      "loopsubdiv",
      {{test::param(ParamType::point3, "P", points), test::param(ParamType::integer, "indices", indices),
        test::param(ParamType::integer, "levels", std::vector<int>{levels})}},
      diagnostics);
  return keep.empty() ? nullptr : keep[0].shape->triangles();
}

class LoopSubdivision : public testing::Test {
 protected:
  const TriangleMesh& make(const MeshData& mesh, int levels) {
    const TriangleMesh* result = subdivided(mesh, levels, keep, diagnostics);
    EXPECT_EQ(test::messages(diagnostics), "");
    return *result;
  }
  std::vector<MadeShape> keep;
  Diagnostics diagnostics;
};

TEST_F(LoopSubdivision, EveryLevelCutsTrianglesInFour) {
  EXPECT_EQ(make(test::box(1, {}), 0).primitive_count(), 12);
  const TriangleMesh& mesh = make(test::box(1, {}), 3);
  EXPECT_EQ(mesh.primitive_count(), 12 * 64);
  EXPECT_TRUE(check_mesh(mesh).sound());
}

// The octahedron's vertices have valence 4: Loop's weight is beta = (5/8 - 9/64) / 4 = 31/256, so a vertex goes to
// (1 - 4 gamma) of itself (its ring's sum is zero), with gamma = 1 / (4 + 96/31) = 31/220. Its normal stays by
// symmetry.
TEST_F(LoopSubdivision, OctahedronsLimitIsKnown) {
  for (const int levels : {0, 1, 4}) {
    const TriangleMesh& mesh = make(test::icosphere(0, 1, {}), levels);
    EXPECT_NEAR(mesh.vertices()[0].x, 1 - 4 * 31.0 / 220, 1e-6) << levels;
    EXPECT_NEAR(mesh.normals()[0].x, 1, 1e-6) << levels;
  }
}

// Normals of the limit surface are those of a fine mesh.
TEST_F(LoopSubdivision, NormalsAreTheSurfaces) {
  const TriangleMesh& mesh = make(test::box(1, {}), 5);
  for (int i = 0; i < mesh.primitive_count(); ++i) {
    const SurfacePoint s = mesh.surface_point(i, {0.3f, 0.3f});
    ASSERT_GT(dot(s.ns, s.ng), 0.995f);
    ASSERT_GT(dot(s.ng, s.p), 0.f);
  }
}

// A flat grid stays flat, its normals too, rims and corners included; its rim is a curve of its own.
TEST_F(LoopSubdivision, RimsAreCurves) {
  MeshData grid;
  const int n = 4;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) grid.vertices.push_back({static_cast<float>(x), static_cast<float>(y), 2});
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x, b = a + n + 1;
      grid.faces.insert(grid.faces.end(), {{a, a + 1, b}, {a + 1, b + 1, b}});
    }
  const TriangleMesh& mesh = make(grid, 3);
  EXPECT_EQ(mesh.primitive_count(), 32 * 64);
  for (const Vec3& v : mesh.normals()) ASSERT_LT(length(v - Vec3{0, 0, 1}), 1e-6f);
  Bounds3 box;
  for (const Vec3& p : mesh.vertices()) box.add(p);
  EXPECT_EQ(box.low.z, 2.f);
  EXPECT_EQ(box.high.x, 4.f);  // straight rims stay where they are, corners are rounded off
  EXPECT_EQ(check_mesh(mesh).holes, 1);
}

TEST_F(LoopSubdivision, BadMeshesAreErrors) {
  EXPECT_EQ(subdivided({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 3}}}, 1, keep, diagnostics), nullptr);
  EXPECT_EQ(subdivided(test::box(1, {}), 11, keep, diagnostics), nullptr);
  EXPECT_EQ(diagnostics.error_count(), 2);
}

}  // namespace
}  // namespace dspm
