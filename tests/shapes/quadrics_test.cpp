// Sphere, disk and cylinder, whole and in part: what rays meet, areas, uniform samples, parameters.
#include <gtest/gtest.h>

#include "dspm/shapes/placed_shape.h"
#include "dspm/testing/chi2.h"
#include "tests/shapes/making.h"
#include "tests/shapes/placed.h"

namespace dspm {
namespace {

using test::make_shape;
using test::Random;

struct Example {
  const char* name;
  std::unique_ptr<Shape> shape;
  float size;
};

std::vector<Example> examples() {
  std::vector<Example> all;
  all.push_back({"sphere", make_shape("sphere", {{"radius", 2}}), 2});
  all.push_back(
      {"part of a sphere", make_shape("sphere", {{"radius", 2}, {"zmin", -1.5f}, {"zmax", 0.5f}, {"phimax", 250}}), 2});
  all.push_back({"disk", make_shape("disk", {{"radius", 3}, {"height", 0.7f}}), 3});
  all.push_back({"ring", make_shape("disk", {{"radius", 3}, {"innerradius", 1}, {"phimax", 100}}), 3});
  all.push_back({"cylinder", make_shape("cylinder", {{"radius", 0.5f}, {"zmin", -1}, {"zmax", 2}}), 2});
  all.push_back({"part of a cylinder", make_shape("cylinder", {{"radius", 0.5f}, {"phimax", 200}}), 1});
  return all;
}

TEST(Quadrics, AreasAreAnalytic) {
  const auto pi = static_cast<double>(kPi);
  const double expected[] = {16 * pi,          250.0 / 360 * 2 * pi * 2 * 2,  9 * pi, 100.0 / 360 * pi * 8,
                             2 * pi * 0.5 * 3, 200.0 / 360 * 2 * pi * 0.5 * 2};
  int i = 0;
  for (const Example& e : examples()) {
    EXPECT_NEAR(e.shape->area(0), expected[i], 1e-6 * expected[i]) << e.name;
    ++i;
  }
}

TEST(Quadrics, ParametersFollowPbrt) {
  const auto sphere = make_shape("sphere", {{"radius", 2}});
  const auto hit = sphere->intersect(0, {{0, 5, 0}, {0, -1, 0}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 3.f);
  EXPECT_FLOAT_EQ(hit->uv.x, 0.25f);  // a quarter of a turn from x to y
  EXPECT_FLOAT_EQ(hit->uv.y, 0.5f);
  EXPECT_FLOAT_EQ(sphere->intersect(0, {{0, 0, -5}, {0, 0, 1}})->uv.y, 0.f);  // zmin is v = 0
  const auto disk = make_shape("disk", {{"radius", 4}, {"innerradius", 2}});
  const auto rim = disk->intersect(0, {{-3, 0, 1}, {0, 0, -1}});
  ASSERT_TRUE(rim);
  EXPECT_FLOAT_EQ(rim->uv.x, 0.5f);
  EXPECT_FLOAT_EQ(rim->uv.y, 0.5f);
  EXPECT_FALSE(disk->intersect(0, {{1, 0, 1}, {0, 0, -1}}));
  const auto cylinder = make_shape("cylinder", {{"radius", 1}, {"zmin", 3}, {"zmax", -1}});
  const auto side = cylinder->intersect(0, {{0, -5, 2}, {0, 1, 0}});
  ASSERT_TRUE(side);
  EXPECT_FLOAT_EQ(side->uv.x, 0.75f);
  EXPECT_FLOAT_EQ(side->uv.y, 0.75f);
}

TEST(Quadrics, RaysStartInsideAndMeetTheSecondRoot) {
  const auto sphere = make_shape("sphere", {{"radius", 2}});
  EXPECT_FLOAT_EQ(sphere->intersect(0, {{1, 0, 0}, {1, 0, 0}})->t, 1.f);
  EXPECT_FLOAT_EQ(sphere->intersect(0, {{1, 0, 0}, {-0.5f, 0, 0}})->t, 6.f);
  EXPECT_FALSE(sphere->intersect(0, {{1, 0, 0}, {1, 0, 0}, 0.5f}));
  const auto bowl = make_shape("sphere", {{"radius", 2}, {"zmax", 0}});
  EXPECT_FLOAT_EQ(bowl->intersect(0, {{0, 0, 5}, {0, 0, -1}})->t, 7.f);  // the near root is cut away
  EXPECT_FALSE(sphere->intersect(0, {{3, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(sphere->intersect(0, {{0, 0, 0}, {0, 0, 0}}));
}

TEST(Quadrics, RaysMayTouch) {
  for (const char* plugin : {"sphere", "cylinder"}) {
    const auto hit = make_shape(plugin, {})->intersect(0, {{1, -5, 0}, {0, 1, 0}});
    ASSERT_TRUE(hit) << plugin;
    EXPECT_EQ(hit->t, 5);
  }
}

TEST(Quadrics, SpheresAreMetFromFarAway) {
  const auto sphere = make_shape("sphere", {{"radius", 0.001f}});
  for (const float distance : {1e3f, 1e5f, 1e7f}) {
    const auto hit = sphere->intersect(0, {{0, distance, 0.0009f}, {0, -1, 0}});
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->t, distance - 0.00043589f);
    EXPECT_NEAR(sphere->surface_point(0, hit->uv).p.z, 0.0009f, 1e-9f);
    EXPECT_FALSE(sphere->intersect(0, {{0, distance, 0.0011f}, {0, -1, 0}}));
  }
}

// A ray aimed at a point of the surface meets the surface there or before; where it does, the surface is on the ray.
TEST(Quadrics, RaysMeetWhatTheyAreAimedAt) {
  Random random(11);
  for (const Example& e : examples()) {
    int exactly = 0;
    for (int i = 0; i < 100'000; ++i) {
      const Vec2 uv{random.uniform(0.01f, 0.99f), random.uniform(0.01f, 0.99f)};
      const SurfacePoint target = e.shape->surface_point(0, uv);
      const Vec3 origin = target.p + random.direction() * random.magnitude(-1, 2);
      const Vec3 w = normalize(target.p - origin);
      const float distance = length(target.p - origin), cosine = std::abs(dot(w, target.ng));
      if (cosine < 0.02f) continue;  // nearly tangential: may miss by rounding
      const auto hit = e.shape->intersect(0, {origin, w});
      ASSERT_TRUE(hit) << e.name;
      // What the float ray can be off by, across and along.
      const float error = 1e-6f * (distance + e.size) / cosine;
      ASSERT_LT(hit->t, distance + error) << e.name;
      const SurfacePoint met = e.shape->surface_point(0, hit->uv);
      const float cosine_met = std::abs(dot(w, met.ng));
      if (cosine_met > 0.02f) {
        ASSERT_LT(length(met.p - (origin + w * hit->t)), 1e-6f * (distance + e.size) / cosine_met) << e.name;
      }
      if (hit->t > distance - error) {
        ++exactly;
        ASSERT_LT(length(met.p - target.p), 2 * error) << e.name;
      }
    }
    EXPECT_GT(exactly, 40'000) << e.name;
  }
}

// Rays through the poles and along the seam at phi = 0 of whole shapes.
TEST(Quadrics, WholeShapesHaveNoSeams) {
  Random random(12);
  for (const float r : {1e-4f, 0.37f, 1.f, 7e4f}) {
    const auto sphere = make_shape("sphere", {{"radius", r}});
    const auto cylinder = make_shape("cylinder", {{"radius", r}, {"zmin", -r}, {"zmax", r}});
    for (int i = 0; i < 100'000; ++i) {
      const Vec3 inside = random.in_cube(0.3f * r);
      const bool pole = i % 2 == 0;
      const Vec3 target = pole ? Vec3{0, 0, i % 4 == 0 ? r : -r} : Vec3{r, 0, random.uniform(-0.4f, 0.4f) * r};
      ASSERT_TRUE(sphere->intersect(0, {inside, normalize(target - inside)}));
      ASSERT_TRUE(pole || cylinder->intersect(0, {inside, normalize(target - inside)}));
    }
  }
}

TEST(Quadrics, BoundsHoldTheSurface) {
  Random random(13);
  for (const Example& e : examples())
    for (int i = 0; i < 20'000; ++i) {
      const Vec2 uv{random.below(5) == 0 ? 1.f : random.uniform(), random.below(5) == 0 ? 1.f : random.uniform()};
      const Vec3 p = e.shape->surface_point(0, uv).p;
      const Bounds3 b = e.shape->bounds(0);
      ASSERT_TRUE(min(p, b.low) == b.low && max(p, b.high) == b.high) << e.name;
    }
}

// Pearson's chi-square at level 0.001: the surface is cut into cells that have equal areas.
TEST(Quadrics, SamplesAreUniformByArea) {
  constexpr int kPhi = 16, kAcross = 10, kSamples = 160'000;
  struct Case {
    const char* name;
    std::unique_ptr<Shape> shape;
    double phi_max, low, high;
    double (*across)(const Vec3& p);  // grows in proportion to area
  };
  const auto z = [](const Vec3& p) -> double { return p.z; };
  const auto rho2 = [](const Vec3& p) { return double{p.x} * p.x + double{p.y} * p.y; };
  std::vector<Case> cases;
  cases.push_back({"sphere", make_shape("sphere", {{"radius", 2}}), 360, -2, 2, z});
  cases.push_back(
      {"part of a sphere", make_shape("sphere", {{"zmin", -0.9f}, {"zmax", 0.2f}, {"phimax", 77}}), 77, -0.9, 0.2, z});
  cases.push_back({"disk", make_shape("disk", {{"radius", 2}}), 360, 0, 4, rho2});
  cases.push_back({"ring", make_shape("disk", {{"radius", 3}, {"innerradius", 2}, {"phimax", 200}}), 200, 4, 9, rho2});
  cases.push_back({"cylinder", make_shape("cylinder", {{"zmin", 1}, {"zmax", 3}, {"phimax", 300}}), 300, 1, 3, z});
  Random random(14);
  for (const Case& c : cases) {
    std::vector<int> counts(kPhi * kAcross);
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 p = c.shape->surface_point(0, c.shape->sample_area(0, random.square())).p;
      double phi = std::atan2(p.y, p.x) * 180 / 3.14159265358979323846;
      if (phi < 0) phi += 360;
      const int column = std::clamp(static_cast<int>(phi / c.phi_max * kPhi), 0, kPhi - 1);
      const int row = std::clamp(static_cast<int>((c.across(p) - c.low) / (c.high - c.low) * kAcross), 0, kAcross - 1);
      ++counts[static_cast<std::size_t>(row * kPhi + column)];
    }
    double chi2 = 0;
    const double expected = double{kSamples} / (kPhi * kAcross);
    for (const int n : counts) chi2 += (n - expected) * (n - expected) / expected;
    EXPECT_GT(test::chi2_tail(chi2, kPhi * kAcross - 1), 0.001) << c.name;
  }
}

// The mean of 1 / pdf over samples is the area: an ellipsoid of revolution with half axes 1, 1, 3.
TEST(Quadrics, PlacedSamplesKnowTheirDensity) {
  const auto sphere = make_shape("sphere", {});
  const PlacedShape placed = test::placed(
      *sphere, Transform(Matrix4::translate(5, 6, 7) * Matrix4::rotate(40, 1, 1, 0) * Matrix4::scale(1, -1, 3)));
  Random random(15);
  double sum = 0;
  const int n = 200'000;
  for (int i = 0; i < n; ++i) {
    const AreaSample s = placed.sample_area(0, random.square());
    EXPECT_GT(dot(s.point.ng, s.point.p - Vec3{5, 6, 7}), 0.f);
    sum += 1 / double{s.pdf_a};
  }
  const double e = std::sqrt(1 - 1.0 / 9), expected = 2 * double{kPi} * (1 + 3 / e * std::asin(e));
  EXPECT_NEAR(sum / n, expected, 0.005 * expected);  // standard deviation of the mean: 0.1 %
}

TEST(Quadrics, BadParametersAreErrors) {
  const auto message = [](const char* plugin, std::initializer_list<std::pair<const char*, float>> numbers) {
    try {
      make_shape(plugin, numbers);
    } catch (const SceneError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(message("sphere", {{"radius", 0}}).find("must be above 0"), std::string::npos);
  EXPECT_NE(message("sphere", {{"zmin", 2}, {"zmax", 3}}).find("nothing of the sphere"), std::string::npos);
  EXPECT_NE(message("disk", {{"innerradius", 1}}).find("below \"radius\""), std::string::npos);
  EXPECT_NE(message("cylinder", {{"zmin", 1}}).find("no height"), std::string::npos);
  EXPECT_NE(message("disk", {{"phimax", -90}}).find("phimax"), std::string::npos);
}

}  // namespace
}  // namespace dspm
