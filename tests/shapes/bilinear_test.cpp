// Bilinear patches: where rays meet them, against many small triangles; edges that do not leak; areas, uniform points
// and their numbers.
#include <gtest/gtest.h>

#include <map>

#include "dspm/shapes/bilinear_patch.h"
#include "dspm/shapes/triangle.h"
#include "tests/shapes/making.h"
#include "tests/shapes/placed.h"

namespace dspm {
namespace {

using test::Random;

constexpr int kMany = 96;  // triangles along a side

BilinearPatch some_patch(Random& random) {
  return {random.in_cube(1), random.in_cube(1), random.in_cube(1), random.in_cube(1)};
}

/// All hits of the ray on a patch as a mesh of small triangles, in order.
std::vector<float> hits_of_triangles(const BilinearPatch& patch, const Ray& ray) {
  std::vector<float> hits;
  const auto at = [&](int x, int y) { return narrow(patch.at(double(x) / kMany, double(y) / kMany)); };
  const TriangleRay prepared(ray);
  for (int y = 0; y < kMany; ++y)
    for (int x = 0; x < kMany; ++x)
      for (const Vec3& third : {at(x + 1, y), at(x, y + 1)})
        if (const auto hit = intersect(prepared, at(x, y), third, at(x + 1, y + 1), ray.t_max)) hits.push_back(hit->t);
  std::sort(hits.begin(), hits.end());
  return hits;
}

std::unique_ptr<Shape> mesh(std::vector<int> indices, const std::vector<Vec3>& vertices, std::vector<Param> more = {}) {
  std::vector<float> points;
  for (const Vec3& p : vertices) points.insert(points.end(), {p.x, p.y, p.z});
  ParamList list{{test::param(ParamType::integer, "indices", std::move(indices)),
                  test::param(ParamType::point3, "P", std::move(points))}};
  for (Param& param : more) list.params.push_back(std::move(param));
  Diagnostics diagnostics;
  auto made = test::make_shapes("bilinearmesh", std::move(list), diagnostics);
  diagnostics.throw_if_errors();
  return std::move(made.at(0).shape);
}

// Rays to points of the patch and past it. The triangles' surface is off by up to 1e-4 of the patch's size; where the
// ray grazes the surface, either may miss it.
TEST(Bilinear, RaysMeetItWhereTheyMeetManyTriangles) {
  Random random(1);
  int hits = 0, seconds = 0, differ = 0;
  for (int i = 0; i < 400; ++i) {
    const BilinearPatch patch = some_patch(random);
    const Vec3 target = narrow(patch.at(random.uniform(-0.3f, 1.3f), random.uniform(-0.3f, 1.3f)));
    const Vec3 origin = random.in_cube(3);
    const Ray ray{origin, normalize(target - origin)};
    const auto expected = hits_of_triangles(patch, ray);
    const auto found = patch.intersect(ray);
    if (found.has_value() != !expected.empty()) {
      ++differ;
      continue;
    }
    if (!found) continue;
    ++hits;
    const Vec3 at = narrow(patch.at(found->uv.x, found->uv.y));
    EXPECT_LT(length(at - ray.at(found->t)), 1e-5f * (1 + length(origin)));
    if (std::abs(found->t - expected.front()) > 2e-2f) ++differ;
    // Beyond the first hit.
    if (expected.back() > expected.front() + 0.05f) ++seconds;
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(seconds, 10);
  EXPECT_LE(differ, 6);
}

TEST(Bilinear, AParallelogramIsTwoTriangles) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random.in_cube(1), a = random.in_cube(1), b = random.in_cube(1);
    const BilinearPatch patch{p, p + a, p + b, p + a + b};
    const Vec3 origin = random.in_cube(3);
    const Ray ray{origin, normalize(p + a * random.uniform(-0.5f, 1.5f) + b * random.uniform(-0.5f, 1.5f) - origin)};
    const TriangleRay prepared(ray);
    const auto first = intersect(prepared, p, p + a, p + a + b, kInfinity);
    const auto second = intersect(prepared, p, p + a + b, p + b, kInfinity);
    const auto hit = patch.intersect(ray);
    const double cosine = std::abs(dot(normalize(cross(a, b)), ray.direction));
    if (cosine < 0.02) continue;
    ASSERT_EQ(hit.has_value(), first || second) << i;
    if (hit) {
      EXPECT_NEAR(hit->t, first ? first->t : second->t, 1e-4f);
    }
  }
}

/// A closed surface of patches, every corner of which is moved at random: a bent cube of n x n patches a side.
std::unique_ptr<Shape> bent_cube(int n, Random& random) {
  std::map<std::array<int, 3>, int> known;
  std::vector<Vec3> vertices;
  std::vector<int> indices;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [found, is_new] = known.try_emplace(at, static_cast<int>(vertices.size()));
    if (is_new)
      vertices.push_back(Vec3{static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])} +
                         random.in_cube(0.3f));
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
          for (int corner = 0; corner < 4; ++corner) {
            std::array<int, 3> at{};
            at[axis] = side, at[(axis + 1) % 3] = x + corner % 2, at[(axis + 2) % 3] = y + corner / 2;
            indices.push_back(vertex(at));
          }
  return mesh(std::move(indices), vertices);
}

// From within, every ray meets it, above all those that aim at vertices and edges.
TEST(Bilinear, AClosedSurfaceDoesNotLeak) {
  Random random(3);
  for (int k = 0; k < 20; ++k) {
    const auto cube = bent_cube(3, random);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 origin = Vec3{1.5f, 1.5f, 1.5f} + random.in_cube(0.5f);
      const int primitive = random.below(cube->primitive_count());
      const float steps[] = {0, 1, 0.5f, random.uniform()};
      const Vec2 uv{steps[random.below(4)], steps[random.below(2)]};
      const Vec3 target = cube->surface_point(primitive, uv).p;
      const Ray ray{origin, normalize(target - origin)};
      bool met = false;
      for (int p = 0; p < cube->primitive_count() && !met; ++p) met = cube->intersect(p, ray).has_value();
      ASSERT_TRUE(met) << k << " " << i;
    }
  }
}

// A ray that leaves a patch does not meet it at once: a saddle sees itself only from a distance, unless it is bent very
// sharply, as a few of these are.
TEST(Bilinear, RaysThatLeaveDoNotMeetItAtOnce) {
  Random random(4);
  int near = 0;
  for (int i = 0; i < 20'000; ++i) {
    const float scale = random.magnitude(-3, 3);
    const BilinearPatch patch = some_patch(random);
    const Vec3 shift = random.below(2) == 0 ? Vec3{} : random.in_cube(100 * scale);
    const auto shape = mesh({0, 1, 2, 3}, {shift + scale * patch.p00, shift + scale * patch.p10,
                                           shift + scale * patch.p01, shift + scale * patch.p11});
    const SurfacePoint point = shape->surface_point(0, random.square());
    const Ray ray = point.spawn(test::leaving(point.ng, random));
    const auto hit = shape->intersect(0, ray);
    near += hit && hit->t < 1e-3f * scale * std::abs(dot(ray.direction, point.ng)) ? 1 : 0;
  }
  EXPECT_LT(near, 10);
}

TEST(Bilinear, AreaIsThatOfManyTriangles) {
  Random random(5);
  for (int i = 0; i < 30; ++i) {
    const BilinearPatch patch = some_patch(random);
    double expected = 0;
    for (int y = 0; y < 256; ++y)
      for (int x = 0; x < 256; ++x) expected += length(patch.normal((x + 0.5) / 256, (y + 0.5) / 256)) / (256 * 256);
    EXPECT_NEAR(patch.area(), expected, 2e-3 * expected);
  }
}

// Points drawn by the shape fall into cells of u and v as often as these have area.
TEST(Bilinear, SamplesAreUniformByArea) {
  Random random(6);
  constexpr int kSide = 8, kSamples = 40'000;
  for (int i = 0; i < 5; ++i) {
    const BilinearPatch patch = some_patch(random);
    std::vector<double> expected(kSide * kSide), found(kSide * kSide);
    for (int y = 0; y < 32 * kSide; ++y)
      for (int x = 0; x < 32 * kSide; ++x) {
        const double n = 32 * kSide;
        expected[static_cast<std::size_t>(y / 32 * kSide + x / 32)] +=
            kSamples * length(patch.normal((x + 0.5) / n, (y + 0.5) / n)) / (n * n * patch.area());
      }
    for (int s = 0; s < kSamples; ++s) {
      const auto uv = patch.uniform(random.square());
      const auto cell = [](double x) { return std::min(static_cast<int>(x * kSide), kSide - 1); };
      found[static_cast<std::size_t>(cell(uv[1]) * kSide + cell(uv[0]))] += 1;
    }
    double chi2 = 0;
    for (std::size_t c = 0; c < expected.size(); ++c)
      chi2 += (found[c] - expected[c]) * (found[c] - expected[c]) / expected[c];
    EXPECT_LT(chi2, 120) << i;  // 63 degrees of freedom: exceeded by right code once in 50,000 times
  }
}

TEST(Bilinear, NumbersLeadBackToSamples) {
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = random.in_cube(1), b = random.in_cube(1), p = random.in_cube(1);
    const auto shape = mesh({0, 1, 2, 3}, {p, p + a, p + b, p + a + b + random.in_cube(0.2f)});
    if (shape->area(0) < 0.05f) continue;
    const Vec2 u{random.uniform(0.02f, 0.98f), random.uniform(0.02f, 0.98f)};
    const Vec2 uv = shape->sample_area(0, u);
    const auto numbers = shape->area_numbers(0, shape->surface_point(0, uv).p);
    ASSERT_TRUE(numbers) << i;
    EXPECT_NEAR(numbers->x, u.x, 2e-3f) << i;
    EXPECT_NEAR(numbers->y, u.y, 2e-3f) << i;
  }
}

TEST(Bilinear, NormalsAndTextureCoordinatesAreThoseOfTheFile) {
  const auto shape =
      mesh({0, 1, 2, 3}, {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}},
           {test::param(ParamType::normal, "N", std::vector<float>{0, 0, -1, 0, 0, -1, 0, 1, -1, 0, 1, -1}),
            test::param(ParamType::point2, "uv", std::vector<float>{0, 0, 0, 4, 4, 0, 4, 4})});
  const SurfacePoint point = shape->surface_point(0, {0.5f, 0.25f});
  EXPECT_EQ(point.ng, (Vec3{0, 0, -1}));  // to the side of the normals
  EXPECT_NEAR(point.ns.y / -point.ns.z, 0.25f, 1e-5f);
  EXPECT_EQ(point.uv, (Vec2{1, 2}));
  EXPECT_NEAR(length(normalize(point.dpdu) - Vec3{0, 1, 0}), 0, 1e-6f);  // texture u runs along y
}

TEST(Bilinear, FaultsAreErrors) {
  const auto message = [](std::vector<int> indices, std::vector<float> points, std::vector<Param> more = {}) {
    ParamList list{{test::param(ParamType::integer, "indices", std::move(indices)),
                    test::param(ParamType::point3, "P", std::move(points))}};
    for (Param& param : more) list.params.push_back(std::move(param));
    Diagnostics diagnostics;
    const auto made = test::make_shapes("bilinearmesh", std::move(list), diagnostics);
    EXPECT_EQ(diagnostics.error_count() > 0, made.empty());
    return test::messages(diagnostics);
  };
  const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  EXPECT_EQ(message({}, square), "");
  EXPECT_NE(message({0, 1, 2, 4}, square).find("vertex 4"), std::string::npos);
  EXPECT_NE(message({}, {0, 0, 0}).find("no patches"), std::string::npos);
  EXPECT_NE(message({}, square, {test::param(ParamType::point2, "uv", std::vector<float>{0, 0})}).find("1 texture"),
            std::string::npos);
  EXPECT_NE(message({}, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, INFINITY}).find("not finite"), std::string::npos);
}

}  // namespace
}  // namespace dspm
