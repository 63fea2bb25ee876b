// Curves: against a slow twin that tries thousands of places, bounds, joints, the surface at a hit, rays that leave,
// parameters.
#include "dspm/shapes/curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/shapes/making.h"
#include "tests/shapes/placed.h"

namespace dspm {
namespace {

using test::Random;

/// A strand of hair, bent a little, with up to that width.
CurveSegment strand(Random& random, float width) {
  Vec3 p[4];
  p[0] = random.in_cube(1);
  Vec3 d = random.direction();
  for (int k = 1; k < 4; ++k) {
    d = normalize(d + random.in_cube(0.3f));
    p[k] = p[k - 1] + d * 0.3f;
  }
  return CurveSegment::of(p, width * random.uniform(0.3f, 1), width * random.uniform(0.3f, 1));
}

Curves settled(Curves curves) {
  curves.settle();
  return curves;
}

Curves curves_of(CurveType type, Random& random, const CurveSegment& segment, int depth = 3) {
  std::vector<RibbonNormals> normals;
  if (type == CurveType::ribbon) {
    const Vec3 n = random.direction();
    normals.push_back({{n, normalize(n + random.in_cube(0.2f))}});
  }
  return settled(Curves(type, std::span(&segment, 1), normals, depth));
}

struct Found {
  PrimitiveHit hit;
  int primitive;
};
std::optional<Found> nearest(const Shape& shape, const Ray& ray) {
  std::optional<Found> best;
  for (int p = 0; p < shape.primitive_count(); ++p)
    if (const auto hit = shape.intersect(p, ray); hit && (!best || hit->t < best->hit.t)) best = Found{*hit, p};
  return best;
}

/// Towards a place within a width of the segment's centre line.
Ray towards(const CurveSegment& segment, Random& random) {
  const double u = static_cast<double>(random.uniform());
  const Vec3 origin = random.in_cube(3);
  const Vec3 target = narrow(place_on(segment, u, {}).p) + random.in_cube(static_cast<float>(segment.width_at(u)));
  return {origin, normalize(target - origin)};
}

/// How far, in projection along the ray, the centre line is from it.
double distance_at(const CurveSegment& segment, double u, const Ray& ray) {
  const DoubleVec3 d = widen(ray.direction), p = place_on(segment, u, ray.origin).p;
  return length(p - d * (dot(p, d) / dot(d, d)));
}

/// The slow twin: the t of the nearest minimum of that distance that is within half a width; infinite: none. nullopt if
/// rounding may decide, or the ends.
std::optional<double> tried_everywhere(const CurveSegment& segment, const Ray& ray) {
  constexpr int kPlaces = 2000;
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kPlaces; ++k) {
    const int before = std::max(k - 1, 0), after = std::min(k + 1, kPlaces);
    const auto at = [&](int i) { return distance_at(segment, double(i) / kPlaces, ray); };
    if (at(k) > at(before) || at(k) > at(after)) continue;
    double low = double(before) / kPlaces, high = double(after) / kPlaces;
    for (int step = 0; step < 60; ++step) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (distance_at(segment, a, ray) < distance_at(segment, b, ray) ? high : low) =
          distance_at(segment, a, ray) < distance_at(segment, b, ray) ? b : a;
    }
    const double u = (low + high) / 2;
    if (u < 1e-9 || u > 1 - 1e-9) continue;  // an end, and no minimum
    const double radius = segment.width_at(u) / 2, gap = std::abs(distance_at(segment, u, ray) - radius);
    if (gap < 1e-3 * radius || u < 2.0 / kPlaces || u > 1 - 2.0 / kPlaces) return std::nullopt;
    const double t = dot(place_on(segment, u, ray.origin).p, widen(ray.direction));
    if (distance_at(segment, u, ray) < radius && t > 0) best = std::min(best, t);
  }
  return best;
}

TEST(Curves, AgreeWithASlowTwin) {
  Random random(31);
  int hits = 0, tried = 0;
  for (int c = 0; c < 200; ++c) {
    const CurveSegment segment = strand(random, random.magnitude(-2.5f, -1));
    const Curves curves = curves_of(c % 2 == 0 ? CurveType::flat : CurveType::cylinder, random, segment, c % 5);
    for (int i = 0; i < 10; ++i) {
      const Ray ray = towards(segment, random);
      // Where the curve is seen end-on it turns quickly in projection.
      const double along = std::abs(dot(direction_at(segment, 0.5), widen(ray.direction)));
      const auto expected = along < 0.95 ? tried_everywhere(segment, ray) : std::nullopt;
      if (!expected) continue;
      const auto found = nearest(curves, ray);
      ++tried;
      ASSERT_EQ(found.has_value(), std::isfinite(*expected)) << c << " " << i;
      if (!found) continue;
      ++hits;
      ASSERT_NEAR(found->hit.t, *expected, 1e-4) << c << " " << i;
    }
  }
  EXPECT_GT(hits, tried / 4);
  EXPECT_GT(tried, 1000);
}

// Neighbouring pieces and segments of a smooth curve leave no gap between them.
TEST(Curves, HaveNoGapsAtJoints) {
  Random random(32);
  std::vector<CurveSegment> segments;  // a uniform spline through random points
  std::vector<Vec3> p;
  for (int i = 0; i < 40; ++i) p.push_back(Vec3{static_cast<float>(i) * 0.2f, 0, 0} + random.in_cube(0.1f));
  ParamList list;
  std::vector<float> numbers;
  for (const Vec3& v : p) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  list.params = {test::param(ParamType::point3, "P", numbers),
                 test::param(ParamType::text, "basis", std::vector<std::string>{"bspline"}),
                 test::param(ParamType::number, "width", std::vector<float>{0.02f})};
  Diagnostics diagnostics;
  const auto made = test::make_shapes("curve", list, diagnostics);
  ASSERT_EQ(made.size(), 1u) << test::messages(diagnostics);
  const Shape& shape = *made[0].shape;
  for (int i = 0; i < 20'000; ++i) {
    // The joint of segments k and k + 1.
    const std::size_t k = 1 + static_cast<std::size_t>(random.below(37));
    const Vec3 joint = (p[k] + 4.f * p[k + 1] + p[k + 2]) / 6,
               origin = joint + random.direction() * random.magnitude(-1, 2);
    if (k + 3 >= p.size() || std::abs(normalize(joint - origin).x) > 0.9f) continue;
    ASSERT_TRUE(nearest(shape, {origin, normalize(joint - origin)})) << i;
  }
}

TEST(Curves, SurfaceIsWhereTheRayMeetsIt) {
  Random random(33);
  for (const CurveType type : {CurveType::flat, CurveType::cylinder, CurveType::ribbon}) {
    int hits = 0;
    for (int i = 0; i < 20'000; ++i) {
      const CurveSegment segment = strand(random, random.magnitude(-2.5f, -1));
      const Curves curves = curves_of(type, random, segment);
      const Ray ray = towards(segment, random);
      const auto found = nearest(curves, ray);
      if (!found) continue;
      const SurfacePoint s = curves.seen(found->primitive, found->hit.uv, ray.direction);
      const auto width = static_cast<float>(segment.width_at(static_cast<double>(found->hit.uv.x)));
      const float along = std::abs(dot(ray.direction, normalize(s.dpdu)));
      if (along > 0.8f || (type == CurveType::ribbon && std::abs(dot(s.ng, ray.direction)) < 0.3f)) continue;
      ++hits;
      ASSERT_TRUE(s.turns);
      ASSERT_NEAR(length(s.ng), 1, 1e-5f);
      ASSERT_NEAR(dot(s.ng, normalize(s.dpdu)), 0, 1e-4f);
      ASSERT_LT(length(s.p - ray.at(found->hit.t)), 0.1f * width + 1e-5f) << i;
      const Bounds3 b = curves.bounds(found->primitive);
      ASSERT_TRUE((min(s.p, b.low) == b.low && max(s.p, b.high) == b.high) || type == CurveType::ribbon);
      if (type == CurveType::flat) {
        ASSERT_LT(dot(s.ng, ray.direction), 0);
      }
    }
    EXPECT_GT(hits, 3000);
  }
}

// As in pbrt: u runs along, v across; the normal of a cylinder leans towards its sides; a mirrored v is its other side.
TEST(Curves, ParametersFollowPbrt) {
  const Vec3 p[4] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const CurveSegment segment = CurveSegment::of(p, 0.2f, 0.2f);
  Random random(1);
  for (const CurveType type : {CurveType::flat, CurveType::cylinder}) {
    const Curves curves = curves_of(type, random, segment);
    const auto left = nearest(curves, {{0.75f, 0.05f, -2}, {0, 0, 1}}),
               right = nearest(curves, {{0.75f, -0.05f, -2}, {0, 0, 1}});
    ASSERT_TRUE(left && right);
    EXPECT_NEAR(left->hit.t, 2, 1e-6f);
    EXPECT_NEAR(left->hit.uv.x, 0.25f, 1e-6f);
    EXPECT_NEAR(left->hit.uv.y + right->hit.uv.y, 1, 1e-5f);
    EXPECT_NEAR(std::abs(left->hit.uv.y - 0.5f), 0.25f, 1e-5f);
    const SurfacePoint s = curves.seen(left->primitive, left->hit.uv, {0, 0, 1});
    const float lean = type == CurveType::cylinder ? std::sqrt(0.5f) : 0;
    EXPECT_LT(length(s.ng - Vec3{0, lean, -std::sqrt(1 - lean * lean)}), 1e-5f);
    EXPECT_LT(length(s.p - Vec3{0.75f, 0.05f, 0}), 1e-6f);
    // v grows along ns x dpdu.
    const float v = dot(cross(Vec3{0, 0, -1}, Vec3{1, 0, 0}), Vec3{0, 1, 0});
    EXPECT_GT(v * (left->hit.uv.y - 0.5f), 0);
    EXPECT_FALSE(nearest(curves, {{0.75f, 0.11f, -2}, {0, 0, 1}}));
    EXPECT_FALSE(nearest(curves, {{3.01f, 0, -2}, {0, 0, 1}}));
  }
}

TEST(Curves, ARibbonShowsItsEdge) {
  const Vec3 p[4] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const CurveSegment segment = CurveSegment::of(p, 0.2f, 0.2f);
  const std::vector<RibbonNormals> normals{{{{0, 0, -1}, {0, 0, -1}}}};
  const Curves ribbon = settled(Curves(CurveType::ribbon, std::span(&segment, 1), normals, 3));
  for (const float degrees : {0.f, 40.f, 80.f, 100.f, 180.f}) {
    const float a = degrees * kPi / 180;
    const Vec3 from{0, std::sin(a), -std::cos(a)}, side{0, std::cos(a), std::sin(a)};
    const float half = 0.1f * std::abs(std::cos(a));
    for (const float across : {-1.02f, -0.98f, 0.5f, 0.98f, 1.02f})
      EXPECT_EQ(nearest(ribbon, {Vec3{1, 0, 0} + 5 * from + side * (across * half), -from}).has_value(),
                std::abs(across) < 1)
          << degrees << " " << across;
  }
  EXPECT_FALSE(nearest(ribbon, {{1, 5, 0}, {0, -1, 0}}));
}

// Straight ones of one width: one that is bent or widens may be met again further along.
TEST(Curves, RaysLeaveThem) {
  Random random(34);
  int met_again = 0;  // by grazing rays, within rounding
  for (const CurveType type : {CurveType::flat, CurveType::cylinder, CurveType::ribbon})
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 a = random.in_cube(1), b = a + random.direction();
      const Vec3 p[4] = {a, a + (b - a) / 3.f, a + (b - a) * (2 / 3.f), b};
      const CurveSegment segment = CurveSegment::of(p, 0.02f, 0.02f);
      const Curves curves = curves_of(type, random, segment);
      const PlacedShape placed = test::placed(
          curves,
          i % 2 == 0 ? Transform()
                     : Transform(Matrix4::translate(3, 4, 5) * Matrix4::rotate(70, 1, 2, 3) * Matrix4::scale(7, 7, 7)));
      const Vec2 uv{random.uniform(0.1f, 0.9f), random.uniform(0.01f, 0.99f)};
      const SurfacePoint s = placed.seen(0, uv, random.direction());
      const Ray ray = s.spawn(test::leaving(s.ng, random));
      const float scale = i % 2 == 0 ? 1 : 7;
      for (int piece = 0; piece < curves.primitive_count(); ++piece)
        met_again += placed.intersect(piece, ray).has_value();
      ASSERT_LT(length(ray.origin - s.p), 0.03f * scale);
    }
  EXPECT_LT(met_again, 60);  // of 60,000
}

TEST(Curves, SegmentsAreThoseOfTheirBasis) {
  const auto points_of = [](const char* basis, int degree, int count) {
    ParamList list;
    std::vector<float> numbers;
    for (int i = 0; i < count; ++i) numbers.insert(numbers.end(), {static_cast<float>(i), 0, 0});
    list.params = {test::param(ParamType::point3, "P", numbers),
                   test::param(ParamType::text, "basis", std::vector<std::string>{basis}),
                   test::param(ParamType::integer, "degree", std::vector<int>{degree}),
                   test::param(ParamType::integer, "splitdepth", std::vector<int>{0})};
    Diagnostics diagnostics;
    auto made = test::make_shapes("curve", list, diagnostics);
    EXPECT_TRUE(diagnostics.all().empty()) << test::messages(diagnostics);
    Bounds3 all;
    for (int i = 0; i < made.at(0).shape->primitive_count(); ++i) all.add(made[0].shape->bounds(i));
    return std::tuple(made[0].shape->primitive_count(), all.low.x + 0.5f, all.high.x - 0.5f);
  };
  const auto expect = [&](const char* basis, int degree, int count, int segments, float low, float high) {
    const auto [found, first, last] = points_of(basis, degree, count);
    EXPECT_EQ(found, segments) << basis << degree;
    EXPECT_NEAR(first, low, 1e-4f) << basis << degree;
    EXPECT_NEAR(last, high, 1e-4f) << basis << degree;
  };
  expect("bezier", 3, 10, 3, 0, 9);
  expect("bezier", 2, 7, 3, 0, 6);
  expect("bspline", 3, 10, 7, 1, 8);
  expect("bspline", 2, 10, 8, 0.5f, 8.5f);
}

TEST(Curves, BadParametersAreErrors) {
  const auto message = [](std::vector<Param> params) {
    Diagnostics diagnostics;
    test::make_shapes("curve", {std::move(params)}, diagnostics);
    return test::messages(diagnostics);
  };
  const Param points = test::param(ParamType::point3, "P", std::vector<float>(12, 0.f));
  const auto text = [](const char* name, const char* value) {
    return test::param(ParamType::text, name, std::vector<std::string>{value});
  };
  EXPECT_EQ(message({points}), "");
  EXPECT_NE(message({}).find("at least 4 control points"), std::string::npos);
  EXPECT_NE(message({test::param(ParamType::point3, "P", std::vector<float>(15, 0.f))}).find("4, 7, 10"),
            std::string::npos);
  EXPECT_NE(message({points, test::param(ParamType::integer, "degree", std::vector<int>{4})}).find("2 or 3"),
            std::string::npos);
  EXPECT_NE(message({points, text("type", "ribbon")}).find("2 normals"), std::string::npos);
  EXPECT_NE(message({points, text("type", "round")}).find("cannot be"), std::string::npos);
  EXPECT_NE(message({points, test::param(ParamType::number, "width0", std::vector<float>{-1})}).find("negative"),
            std::string::npos);
}

// Points that coincide, no width, a point far away: nothing is met, or something finite.
TEST(Curves, DegenerateOnesAreHarmless) {
  Random random(35);
  for (int i = 0; i < 2000; ++i) {
    Vec3 p[4];
    for (Vec3& v : p) v = random.below(3) == 0 ? Vec3{} : random.in_cube(1) * (random.below(9) == 0 ? 1e18f : 1.f);
    const CurveSegment segment = CurveSegment::of(p, random.below(2) == 0 ? 0 : 0.5f, random.below(2) == 0 ? 0 : 0.5f);
    for (const CurveType type : {CurveType::flat, CurveType::cylinder, CurveType::ribbon}) {
      const Curves curves = curves_of(type, random, segment, 10);
      const Vec3 origin = random.in_cube(2);
      const Ray ray{origin, random.below(2) == 0 ? random.direction() : normalize(-origin)};
      if (const auto found = nearest(curves, ray)) {
        const SurfacePoint s = curves.seen(found->primitive, found->hit.uv, ray.direction);
        ASSERT_TRUE(is_finite(s.p) && is_finite(s.ng) && is_finite(s.dpdu));
        ASSERT_NEAR(length(s.ng), 1, 1e-4f);
        ASSERT_TRUE(std::isfinite(found->hit.t) && found->hit.uv.x >= 0 && found->hit.uv.x <= 1);
      }
    }
  }
}

}  // namespace
}  // namespace dspm
