// Rays that leave a surface do not meet it again where they leave: all shapes, at all scales, far from the origin,
// flat.
#include <gtest/gtest.h>

#include "dspm/shapes/triangle_mesh.h"
#include "tests/shapes/making.h"
#include "tests/shapes/placed.h"

namespace dspm {
namespace {

using test::Random;

Transform random_transform(Random& random, bool uniform) {
  const double s = random.magnitude(-4, 5);
  const auto factor = [&] { return uniform ? s : s * random.uniform(0.5f, 2) * (random.below(2) != 0 ? 1 : -1); };
  const double sx = factor(), sy = factor(), sz = factor();
  const Vec3 axis = random.direction(), shift = random.direction() * random.magnitude(-2, 3);
  Matrix4 rotation;
  if (random.below(4) != 0) rotation = Matrix4::rotate(random.uniform(0, 360), axis.x, axis.y, axis.z);
  return Transform(Matrix4::translate(shift.x * s, shift.y * s, shift.z * s) * rotation * Matrix4::scale(sx, sy, sz));
}

// How a spawned ray may meet the shape again: not at all, or on the other side of what it has left.
struct Leaves {
  const char* name;
  std::unique_ptr<Shape> shape;
  bool hollow;
};

std::vector<Leaves> shapes() {
  std::vector<Leaves> all;
  all.push_back({"sphere", test::make_shape("sphere", {{"radius", 1.3f}}), true});
  all.push_back({"half a sphere", test::make_shape("sphere", {{"zmin", -0.2f}, {"phimax", 180}}), true});
  all.push_back({"cylinder", test::make_shape("cylinder", {{"radius", 0.7f}}), true});
  all.push_back({"disk", test::make_shape("disk", {{"height", 0.3f}}), false});
  const MeshData triangle{{{0.3f, -0.2f, 0.1f}, {1, 0.4f, 0.2f}, {-0.3f, 1, -0.6f}}, {}, {}, {{0, 1, 2}}};
  all.push_back({"triangle", std::make_unique<TriangleMesh>(triangle), false});
  return all;
}

void expect_leaves(const Leaves& leaves, const PlacedShape& placed, float scale, Random& random) {
  const SurfacePoint s = placed.surface_point(0, leaves.shape->sample_area(0, random.square()));
  const Vec3 w = test::leaving(s.ng, random);
  const Ray ray = s.spawn(w);
  const float size = scale * 4 + length(s.p);
  ASSERT_LT(length(ray.origin - s.p), 1e-4f * size) << leaves.name;

  const auto again = placed.intersect(0, ray);
  const float cosine = dot(w, s.ng);
  if (!leaves.hollow || cosine > 0) {
    ASSERT_FALSE(again) << leaves.name << " at " << cosine;
  } else if (again && cosine < -0.05f) {  // a chord is as long as the smallest sphere of curvature allows, at least
    ASSERT_GT(again->t, 0.1f * -cosine * scale) << leaves.name;
  }
}

TEST(Spawn, RaysLeaveShapesInTheirOwnSpace) {
  Random random(21);
  for (const Leaves& leaves : shapes())
    for (int i = 0; i < 200'000; ++i) expect_leaves(leaves, test::placed(*leaves.shape, {}), 1, random);
}

TEST(Spawn, RaysLeavePlacedShapes) {
  Random random(22);
  for (const Leaves& leaves : shapes())
    for (int i = 0; i < 4000; ++i) {
      const Transform t = random_transform(random, i % 2 == 0);
      const float scale =
          std::min(length(t.vector({1, 0, 0})), std::min(length(t.vector({0, 1, 0})), length(t.vector({0, 0, 1}))));
      if (length(t.point({})) > 500 * scale && leaves.hollow) continue;  // the far side is no farther than rounding
      for (int k = 0; k < 50; ++k) expect_leaves(leaves, test::placed(*leaves.shape, t), scale, random);
    }
}

}  // namespace
}  // namespace dspm
