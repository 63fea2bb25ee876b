// Polygons to triangles: fans, concave polygons, polygons that meet themselves.
#include "dspm/shapes/polygons.h"

#include <gtest/gtest.h>

#include "dspm/shapes/triangle.h"
#include "tests/shapes/random.h"

namespace dspm {
namespace {

Polygons one_polygon(int corners) {
  Polygons p;
  for (int i = 0; i < corners; ++i) p.add_corner(i);
  p.close();
  return p;
}

double area(const std::vector<Face>& faces, const std::vector<Vec3>& v, bool signed_z) {
  double sum = 0;
  for (const auto& [a, b, c] : faces) {
    const DoubleVec3 n =
        area_vector(v[static_cast<std::size_t>(a)], v[static_cast<std::size_t>(b)], v[static_cast<std::size_t>(c)]);
    sum += (signed_z ? n.z : length(n)) / 2;
  }
  return sum;
}

TEST(Polygons, ConvexOnesBecomeFans) {
  const std::vector<Vec3> v{{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(one_polygon(5), v), (std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(Polygons, FewerThanThreeCornersAreNoTriangle) {
  Polygons p = one_polygon(2);
  p.close();
  for (int i = 0; i < 3; ++i) p.add_corner(i);
  p.close();
  EXPECT_EQ(triangulate(p, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), (std::vector<Face>{{0, 1, 2}}));
}

// Star-shaped polygons, seen from any direction: no triangle is turned over, so areas add up to the polygon's.
TEST(Polygons, ConcaveOnesAreCoveredOnce) {
  test::Random random(31);
  for (int round = 0; round < 2000; ++round) {
    const int n = 4 + random.below(12);
    std::vector<Vec3> flat;
    double expected = 0;
    for (int i = 0; i < n; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(n), r = random.uniform(0.2f, 1);
      flat.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    for (std::size_t i = 0; i < flat.size(); ++i) {
      const Vec3 &a = flat[i], &b = flat[(i + 1) % flat.size()];
      expected += 0.5 * (double{a.x} * b.y - double{a.y} * b.x);
    }
    const std::vector<Face> faces = triangulate(one_polygon(n), flat);
    ASSERT_EQ(static_cast<int>(faces.size()), n - 2);
    ASSERT_NEAR(area(faces, flat, true), expected, 1e-5);
    ASSERT_NEAR(area(faces, flat, false), expected, 1e-5);
    const Basis basis = Basis::around(random.direction());
    std::vector<Vec3> turned;
    for (const Vec3& p : flat) turned.push_back(basis.to_world(p));
    ASSERT_NEAR(area(triangulate(one_polygon(n), turned), turned, false), expected, 1e-4);
  }
}

TEST(Polygons, NothingHangsOnNonsense) {
  const std::vector<Vec3> same(6), bow{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(one_polygon(6), same).size(), 4u);
  EXPECT_EQ(triangulate(one_polygon(4), bow).size(), 2u);
}

}  // namespace
}  // namespace dspm
