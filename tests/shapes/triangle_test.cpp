// The triangle test: known hits, watertightness on closed meshes, and independence of the order of vertices.
#include "dspm/shapes/triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dspm/base/math/rounding.h"
#include "dspm/shapes/triangle_mesh.h"
#include "tests/shapes/meshes.h"
#include "tests/shapes/random.h"

namespace dspm {
namespace {

using test::Random;

const Vec3 kA{0, 0, 0}, kB{1, 0, 0}, kC{0, 1, 0};

TEST(Triangle, HitsWhereThePlaneIsMet) {
  // The plane x + y + z = 1; the ray along the diagonal meets it in (1/3, 1/3, 1/3).
  const auto hit = intersect(TriangleRay({{-1, -1, -1}, {1, 1, 1}}), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, kInfinity);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 4.f / 3, 1e-6f);
  EXPECT_NEAR(hit->uv.x, 1.f / 3, 1e-6f);
  EXPECT_NEAR(hit->uv.y, 1.f / 3, 1e-6f);
}

TEST(Triangle, BothEndsOfTheRayAreOpen) {
  const Vec3 down{0, 0, -1};
  EXPECT_FALSE(intersect(TriangleRay({{0.2f, 0.2f, 0}, down}), kA, kB, kC, kInfinity));
  EXPECT_FALSE(intersect(TriangleRay({{0.2f, 0.2f, 1}, down}), kA, kB, kC, 1.f));
  EXPECT_TRUE(intersect(TriangleRay({{0.2f, 0.2f, 1}, down}), kA, kB, kC, std::nextafter(1.f, 2.f)));
  EXPECT_FALSE(intersect(TriangleRay({{0.2f, 0.2f, -1}, down}), kA, kB, kC, kInfinity));
}

TEST(Triangle, DistanceIsInUnitsOfTheDirection) {
  const auto hit = intersect(TriangleRay({{0.25f, 0.5f, 8}, {0, 0, -2}}), kA, kB, kC, kInfinity);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 4.f);
  EXPECT_EQ(hit->uv, (Vec2{0.25f, 0.5f}));
}

TEST(Triangle, DegenerateTrianglesAreNeverHit) {
  Random random(1);
  for (int i = 0; i < 200'000; ++i) {
    // Exactly collinear: integer points on a line, seen from anywhere, aimed at.
    const Vec3 p{static_cast<float>(random.below(64)), static_cast<float>(random.below(64)), 3};
    const Vec3 step{static_cast<float>(random.below(9)), static_cast<float>(random.below(9)), 1};
    const Vec3 q = p + step * static_cast<float>(random.below(9)), r = p + step * static_cast<float>(random.below(9));
    const Vec3 origin = random.in_cube(100);
    const Vec3 target = p + step * random.uniform(0, 8);
    EXPECT_FALSE(intersect(TriangleRay({origin, normalize(target - origin)}), p, q, r, kInfinity));
  }
  EXPECT_FALSE(intersect(TriangleRay({{0, 0, 1}, {0, 0, -1}}), kA, kA, kA, kInfinity));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(intersect(TriangleRay({{0.1f, 0.1f, 1}, {0, 0, -1}}), kA, {1, 0, nan}, kC, kInfinity));
}

// Which vertex comes first, and which way round, decides neither whether the triangle is hit nor the hit's place.
TEST(Triangle, OrderOfVerticesDoesNotMatter) {
  Random random(2);
  for (int i = 0; i < 300'000; ++i) {
    std::array<Vec3, 3> p{random.in_cube(1), random.in_cube(1), random.in_cube(1)};
    const Vec3 origin = random.in_cube(3);
    const float b = random.uniform();
    const float rest = random.below(2) != 0 ? 0.f : (1 - b) * b;  // 0: a point of an edge
    const Vec3 aim = p[0] * b + p[1] * (1 - b - rest) + p[2] * rest;
    const TriangleRay ray({origin, normalize(aim - origin)});
    const auto first = intersect(ray, p[0], p[1], p[2], kInfinity);
    std::array<int, 3> order{0, 1, 2};
    while (std::next_permutation(order.begin(), order.end())) {
      const auto index = [&](int k) { return static_cast<std::size_t>(order[static_cast<std::size_t>(k)]); };
      const auto other = intersect(ray, p[index(0)], p[index(1)], p[index(2)], kInfinity);
      ASSERT_EQ(first.has_value(), other.has_value());
      if (!first) continue;
      EXPECT_NEAR(first->t, other->t, 1e-3f * first->t);
    }
  }
}

// A point of a common edge is hit on the one triangle or the other, at one distance.
TEST(Triangle, SharedEdgesAreOnePlace) {
  Random random(7);
  int both = 0;
  for (int i = 0; i < 500'000; ++i) {
    const Vec3 a = random.in_cube(1), b = random.in_cube(1), c = random.in_cube(1);
    const Vec3 d = a + b - c + 0.5f * random.in_cube(1);  // across the edge from c
    const Vec3 target = a + (b - a) * random.uniform(), origin = target + random.direction() * random.magnitude(-2, 2);
    const TriangleRay ray({origin, target - origin});
    const auto one = intersect(ray, a, b, c, kInfinity), other = intersect(ray, b, a, d, kInfinity);
    if (!one || !other) continue;
    ++both;
    const DoubleVec3 n = area_vector(a, b, c), m = area_vector(b, a, d);
    const double flat = std::min(std::abs(dot(n, widen(ray.direction))) / length(n),
                                 std::abs(dot(m, widen(ray.direction))) / length(m));
    ASSERT_NEAR(one->t, other->t, 2e-6 * (1 + length(target - origin)) / flat);
  }
  EXPECT_GT(both, 1000);
}

bool meets(const TriangleMesh& mesh, const Ray& ray) {
  const TriangleRay prepared(ray);
  for (int k = 0; k < mesh.primitive_count(); ++k)
    if (intersect(prepared, mesh.vertex(k, 0), mesh.vertex(k, 1), mesh.vertex(k, 2), kInfinity)) return true;
  return false;
}

// Rays from inside a closed mesh, aimed exactly at its vertices and at points of its edges, hit something.
void expect_no_leak(const TriangleMesh& mesh, const Vec3& inside, Random& random, int rays) {
  for (int i = 0; i < rays; ++i) {
    const int face = random.below(mesh.primitive_count()), corner = random.below(3);
    const Vec3 a = mesh.vertex(face, corner), b = mesh.vertex(face, (corner + 1) % 3);
    const float s = random.below(3) == 0 ? 0.f : random.uniform();
    const Vec3 origin = inside + random.in_cube(0.2f) * length(a - inside);
    const Vec3 direction = (a + (b - a) * s) - origin;
    const Vec3 d = random.below(2) != 0 ? normalize(direction) : direction;
    ASSERT_TRUE(meets(mesh, {origin, d})) << "leak after " << i << " rays";
  }
}

TEST(Triangle, ClosedMeshesDoNotLeak) {
  Random random(3);
  for (const float scale : {1e-4f, 1.f, 1e5f})
    for (const float distance : {0.f, 1.f, 1000.f}) {
      const Vec3 center = Vec3{1, -0.7f, 0.3f} * (scale * distance);
      expect_no_leak(TriangleMesh(test::icosphere(1, scale, center)), center, random, 100'000);
      expect_no_leak(TriangleMesh(test::box(scale, center)), center, random, 200'000);
      expect_no_leak(TriangleMesh(test::icosphere(3, scale, center)), center, random, 2'000);
    }
}

// A thin triangle seen from its own plane's neighbourhood: the distance stays that of the plane.
TEST(Triangle, ThinTrianglesKeepTheirDistance) {
  Random random(6);
  for (int i = 0; i < 300'000; ++i) {
    const Vec3 a = random.in_cube(1), along = random.direction(), aside = random.direction();
    const Vec3 b = a + along, c = a + along * random.uniform() + aside * random.magnitude(-6, 0);
    const Vec3 target = a * 0.3f + b * 0.3f + c * 0.4f, direction = random.direction();
    const float distance = random.uniform(0.1f, 2);
    const DoubleVec3 n = area_vector(a, b, c);
    const double cosine = std::abs(dot(n, widen(direction))) / std::sqrt(dot(n, n));
    const auto hit = intersect(TriangleRay({target - direction * distance, direction}), a, b, c, kInfinity);
    if (!hit || cosine < 0.01) continue;
    EXPECT_NEAR(hit->t, distance, 1e-6 / cosine);
  }
}

// Rays along an axis through the vertices of a grid: every coordinate difference is exact, edge functions are zero.
TEST(Triangle, ClosedMeshesDoNotLeakAlongTheAxes) {
  const TriangleMesh mesh(test::box(1, {}));
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.f, 1.f})
      for (int i = -8; i <= 8; ++i)
        for (int j = -8; j <= 8; ++j) {
          Vec3 origin, direction;
          direction[axis] = sign;
          origin[(axis + 1) % 3] = static_cast<float>(i) / 8;
          origin[(axis + 2) % 3] = static_cast<float>(j) / 8;
          EXPECT_TRUE(meets(mesh, {origin, direction})) << i << ' ' << j;
        }
}

// The hardest rays: they run in the plane of a face and are aimed at its rim. Along the axes none leaks. In general
// position rounding decides whether such a face is before or behind the origin; measured: 1 ray in 13,000 leaks.
TEST(Triangle, RaysInAFacesPlane) {
  Random random(8);
  const TriangleMesh piece(test::corner_piece());
  for (const bool turned : {false, true}) {
    int leaks = 0;
    for (int round = 0; round < 100; ++round) {
      const Vec3 axis = random.direction();
      Matrix4 matrix;
      if (turned)
        matrix = Matrix4::translate(1, -2, 0.5) * Matrix4::rotate(random.uniform(0, 360), axis.x, axis.y, axis.z);
      const Transform t(matrix);
      const TriangleMesh mesh = piece.transformed(t);
      for (int i = 0; i < 3000; ++i) {
        const Vec3 origin = t.point({1, random.uniform(0.1f, 0.9f), random.uniform(0.1f, 0.9f)});
        const bool along_y = random.below(2) != 0;
        const Vec3 target{1, along_y ? random.uniform(1, 2) : 1.f, along_y ? 0.f : random.uniform()};
        leaks += meets(mesh, {origin, normalize(t.point(target) - origin)}) ? 0 : 1;
      }
    }
    EXPECT_LE(leaks, turned ? 60 : 0);
  }
}

}  // namespace
}  // namespace dspm
