// The derivatives of a surface by its texture coordinates against differences, and the ellipse that a disk covers.
#include <gtest/gtest.h>

#include "dspm/shapes/placed_shape.h"
#include "dspm/shapes/triangle_mesh.h"
#include "tests/shapes/making.h"
#include "tests/shapes/placed.h"

namespace dspm {
namespace {

using test::make_shape;
using test::Random;

std::unique_ptr<Shape> patch(std::vector<Param> more) {
  ParamList list{
      {test::param(ParamType::integer, "indices", std::vector<int>{0, 1, 2, 3}),
       test::param(ParamType::point3, "P", std::vector<float>{0, 0, 0, 1, 0.2f, 0, 0.3f, 2, 1, 1, 1.5f, 0})}};
  for (Param& param : more) list.params.push_back(std::move(param));
  Diagnostics diagnostics;
  auto made = test::make_shapes("bilinearmesh", std::move(list), diagnostics);
  return std::move(made.at(0).shape);
}

std::vector<std::unique_ptr<Shape>> shapes_with_tangents() {
  std::vector<std::unique_ptr<Shape>> all;
  all.push_back(make_shape("sphere", {{"radius", 2}}));
  all.push_back(make_shape("sphere", {{"radius", 2}, {"zmin", -1.5f}, {"zmax", 0.5f}, {"phimax", 250}}));
  all.push_back(make_shape("disk", {{"radius", 3}, {"innerradius", 1}, {"phimax", 100}}));
  all.push_back(make_shape("cylinder", {{"radius", 0.5f}, {"zmin", -1}, {"zmax", 2}, {"phimax", 200}}));
  MeshData triangles{{{0, 0, 0}, {1, 0.2f, 0}, {0.3f, 2, 1}}, {}, {}, {{0, 1, 2}}};
  all.push_back(std::make_unique<TriangleMesh>(triangles));
  triangles.uvs = {{0.1f, 2}, {-0.5f, 0.3f}, {1, 0.7f}};
  all.push_back(std::make_unique<TriangleMesh>(triangles));
  all.push_back(patch({}));
  all.push_back(patch({test::param(ParamType::point2, "uv", std::vector<float>{0, 0, 2, 0.3f, 0.1f, 1, 1.5f, 2})}));
  return all;
}

TEST(Tangents, AreDerivativesByTextureCoordinates) {
  const Transform to_world(Matrix4::translate(1, 2, 3) * Matrix4::rotate(40, 1, 1, 0) * Matrix4::scale(1, -2, 0.5));
  Random random(5);
  int shape = 0;
  for (const auto& s : shapes_with_tangents()) {
    const PlacedShape placed = test::placed(*s, to_world);
    for (int i = 0; i < 300; ++i) {
      const Vec2 at{random.uniform(0.1f, 0.4f), random.uniform(0.1f, 0.4f)};
      const Vec2 step{random.uniform(-5e-3f, 5e-3f), random.uniform(-5e-3f, 5e-3f)};
      const SurfacePoint here = placed.surface_point(0, at);
      const SurfacePoint before = placed.surface_point(0, at - step), after = placed.surface_point(0, at + step);
      const Vec2 change = after.uv - before.uv;
      const Vec3 moved = after.p - before.p, expected = here.dpdu * change.x + here.dpdv * change.y;
      EXPECT_LT(length(moved - expected), 2e-3f * length(moved) + 1e-5f) << "shape " << shape;
    }
    ++shape;
  }
}

// A tangent of a file is a direction; its sign says to which side v runs, whatever the texture coordinates say.
TEST(Tangents, OfFilesTurnThoseOfTextureCoordinates) {
  MeshData data{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {}, {{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}};
  data.tangents.assign(3, {5, 5, 0});
  for (const bool turned : {false, true}) {
    data.turned.assign(3, turned);
    const TriangleMesh mesh(data);
    const SurfacePoint here = mesh.surface_point(0, {0.2f, 0.2f});
    const float half = std::sqrt(2.f);  // of dpdu's length of 2
    EXPECT_LT(length(here.dpdu - Vec3{half, half, 0}), 1e-6f);
    EXPECT_EQ(here.dpdv, (Vec3{0, turned ? -2.f : 2.f, 0}));
    const SurfacePoint mirrored = mesh.transformed(Transform(Matrix4::scale(-1, 1, 1))).surface_point(0, {0.2f, 0.2f});
    EXPECT_LT(length(mirrored.dpdu - Vec3{-half, half, 0}), 1e-6f);
    EXPECT_EQ(mirrored.dpdv, here.dpdv);
  }
  data.turned.pop_back();
  EXPECT_EQ(fault_of(data), "2 signs for 3 tangents");
}

TEST(Tangents, AreNeverZeroAndUnknownWhereTextureCoordinatesAreDegenerate) {
  const auto sphere = make_shape("sphere", {{"radius", 2}});
  const auto disk = make_shape("disk", {{"radius", 2}});
  for (const SurfacePoint& pole :
       {sphere->surface_point(0, {0.3f, 0}), sphere->surface_point(0, {0.3f, 1}), disk->surface_point(0, {0.3f, 1})})
    EXPECT_GT(length2(pole.dpdu), 0);
  const TriangleMesh flat(MeshData{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {{0, 0}, {0, 1}, {0, 2}}, {{0, 1, 2}}});
  EXPECT_GT(length2(flat.surface_point(0, {0.2f, 0.2f}).dpdu), 0);
  EXPECT_EQ(flat.surface_point(0, {0.2f, 0.2f}).dpdv, Vec3{});
}

// Seen along the ray, both axes are as long as the disk is wide, and perpendicular.
TEST(Footprint, IsTheDisksShadowOnTheSurface) {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    SurfacePoint point;
    point.ng = random.direction();
    const Vec3 w = random.direction();
    const float cosine = std::abs(dot(w, point.ng));
    if (cosine < 0.01f) continue;
    point.cover(w, 0.5f);
    const auto across = [&](const Vec3& v) { return v - w * dot(v, w); };
    EXPECT_NEAR(dot(point.dpdx, point.ng), 0, 1e-5f / cosine);
    EXPECT_NEAR(dot(point.dpdy, point.ng), 0, 1e-5f / cosine);
    EXPECT_NEAR(length(across(point.dpdx)), 0.5f, 1e-4f);
    EXPECT_NEAR(length(across(point.dpdy)), 0.5f, 1e-4f / cosine);
    EXPECT_NEAR(dot(across(point.dpdx), across(point.dpdy)), 0, 1e-4f / cosine);
  }
  SurfacePoint point;
  point.ng = {0, 0, 1};
  for (const Vec3& w : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}}) {
    point.cover(w, 0.5f);
    EXPECT_TRUE(is_finite(point.dpdx) && is_finite(point.dpdy));
    EXPECT_FLOAT_EQ(length(point.dpdx), 0.5f);
  }
}

}  // namespace
}  // namespace dspm
