// Mappings of the sphere, and importance sampling of an image on it.
#include "dspm/lights/environment_map.h"

#include <gtest/gtest.h>

#include "tests/lights/density.h"
#include "tests/lights/environment.h"

namespace dspm {
namespace {

using namespace dspm::test;

constexpr SphereMapping kMappings[] = {SphereMapping::equal_area, SphereMapping::equirectangular};

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-6f) {
  EXPECT_LT(max_component(abs(a - b)), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

// The square as the octahedron unfolded: the axes' directions at its middle, edges' middles and corners. [Clarberg
// 2008]
TEST(SphereMapping, EqualAreaHasTheAxesWherePbrtHasThem) {
  const auto at = [](float x, float y) { return direction_at(SphereMapping::equal_area, {x, y}); };
  expect_near(at(0.5f, 0.5f), {0, 0, 1});
  expect_near(at(1, 0.5f), {1, 0, 0});
  expect_near(at(0, 0.5f), {-1, 0, 0});
  expect_near(at(0.5f, 1), {0, 1, 0});
  expect_near(at(0.5f, 0), {0, -1, 0});
  for (const float x : {0.f, 1.f})
    for (const float y : {0.f, 1.f}) expect_near(at(x, y), {0, 0, -1});
  // Half way to an edge: r = 1/2, z = 1 - r^2, on the axis of the quadrant's border.
  expect_near(at(0.75f, 0.5f), {std::sqrt(1 - 0.5625f), 0, 0.75f});
  expect_near(at(0.875f, 0.875f), {std::sqrt(0.5f - 0.5f * 0.5625f), std::sqrt(0.5f - 0.5f * 0.5625f), -0.75f});
}

TEST(SphereMapping, EquirectangularHasTheAxesWherePbrtHasThem) {
  const auto at = [](float x, float y) { return direction_at(SphereMapping::equirectangular, {x, y}); };
  expect_near(at(0, 0.5f), {1, 0, 0});
  expect_near(at(0.25f, 0.5f), {0, 1, 0});
  expect_near(at(0.5f, 0.5f), {-1, 0, 0});
  expect_near(at(0.75f, 0.5f), {0, -1, 0});
  expect_near(at(0.3f, 0), {0, 0, 1});
  expect_near(at(0.3f, 1), {0, 0, -1});
}

TEST(SphereMapping, PlacesAndDirectionsAreInverse) {
  Sequence random(1);
  for (const SphereMapping mapping : kMappings)
    for (int i = 0; i < 100'000; ++i) {
      const Vec3 w = uniform_sphere(random.pair());
      const Vec2 place = place_of(mapping, w);
      EXPECT_TRUE(place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1);
      const Vec3 back = direction_at(mapping, place);
      expect_near(back, w, 2e-6f);
      EXPECT_NEAR(length(back), 1, 1e-6f);
    }
}

TEST(SphereMapping, ExtremeDirectionsHavePlaces) {
  for (const SphereMapping mapping : kMappings)
    for (const Vec3 w : {Vec3{1, 0, 0},
                         {-1, 0, 0},
                         {-1, -0.f, 0},
                         {0, 1, 0},
                         {0, -1, 0},
                         {0, 0, 1},
                         {0, 0, -1},
                         {1e-30f, -1e-30f, 1},
                         {-1e-20f, 1e-10f, -1},
                         {1, -1e-12f, -1e-12f}}) {
      const Vec2 place = place_of(mapping, w);
      EXPECT_TRUE(place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1);
      expect_near(direction_at(mapping, place), w);
    }
}

// Equal parts of the square hold equal numbers of directions that are uniform over the sphere.
TEST(SphereMapping, EqualAreaKeepsAreas) {
  constexpr int n = 16, samples = 400'000;
  std::vector<int> counts(n * n);
  Sequence random(2);
  for (int i = 0; i < samples; ++i) {
    const Vec2 p = place_of(SphereMapping::equal_area, uniform_sphere(random.pair()));
    const int x = std::min(static_cast<int>(p.x * n), n - 1), y = std::min(static_cast<int>(p.y * n), n - 1);
    ++counts[static_cast<std::size_t>(y * n + x)];
  }
  double statistic = 0;
  const double expected = samples / double{n * n};
  for (const int count : counts) statistic += (count - expected) * (count - expected) / expected;
  EXPECT_GT(chi2_tail(statistic, n * n - 1), 0.001);
}

TEST(EnvironmentMap, SamplesFollowTheirDensity) {
  for (const SphereMapping mapping : kMappings) {
    const EnvironmentMap map(random_environment(10, 5), mapping);
    DensityComparison comparison;
    comparison.add_samples(200'000, [&](Sequence& random) { comparison.sample(map.sample(random.pair()).direction); });
    comparison.add_claims(200'000, [&](const Vec3& w) { return map.pdf_w(w); });
    EXPECT_GT(comparison.p_value(), 0.001);
    EXPECT_LT(comparison.deviation(), 4);
  }
}

// Luminance over density is one number: what a map of that luminance has in all. Nothing black is ever drawn.
TEST(EnvironmentMap, SamplesAreProportionalToLuminance) {
  for (const SphereMapping mapping : kMappings) {
    const EnvironmentMap map(random_environment(10, 5), mapping);
    const float whole = luminance(map.fluence());
    Sequence random(4);
    for (int i = 0; i < 100'000; ++i) {
      const EnvironmentMap::Sample s = map.sample(random.pair());
      EXPECT_NEAR(luminance(s.radiance) / s.pdf_w, whole, 1e-4f * whole);
      EXPECT_NEAR(length(s.direction), 1, 1e-6f);
    }
  }
}

// Away from the pixels' borders, what was drawn is what is seen there.
TEST(EnvironmentMap, SamplesAreWhatIsSeen) {
  for (const SphereMapping mapping : kMappings) {
    const EnvironmentMap map(random_environment(10, 5), mapping);
    Sequence random(5);
    int differ = 0;
    for (int i = 0; i < 100'000; ++i) {
      const EnvironmentMap::Sample s = map.sample(random.pair());
      if (map.radiance(s.direction) == s.radiance)
        EXPECT_EQ(map.pdf_w(s.direction), s.pdf_w);
      else
        ++differ;
    }
    EXPECT_LT(differ, 20);
  }
}

TEST(EnvironmentMap, FluenceAndIlluminanceAreIntegrals) {
  for (const SphereMapping mapping : kMappings) {
    Image white(64, 32);
    std::fill(white.pixels.begin(), white.pixels.end(), Rgb(2));
    const EnvironmentMap map(std::move(white), mapping);
    EXPECT_NEAR(map.fluence().g, 8 * kPi, 1e-4f);
    EXPECT_NEAR(map.illuminance(), 2 * kPi, 2e-3f * 2 * kPi);  // midpoint rule over 64 x 32 pixels
  }
}

// A sun of one pixel in a sky of two million.
TEST(EnvironmentMap, OneBrightPixelGetsItsShare) {
  constexpr int w = 2048, h = 1024, x = 700, y = 300, n = 20'000;
  for (const SphereMapping mapping : kMappings) {
    Image image(w, h);
    std::fill(image.pixels.begin(), image.pixels.end(), Rgb(1));
    image.at(x, y) = Rgb(1e6f);
    const EnvironmentMap map(std::move(image), mapping);
    const double solid_angle = mapping == SphereMapping::equal_area
                                   ? 4 * M_PI / (w * h)
                                   : 2 * M_PI / w * (std::cos(M_PI * y / h) - std::cos(M_PI * (y + 1) / h));
    const double whole = 4 * M_PI + (1e6 - 1) * solid_angle, share = 1e6 * solid_angle / whole;
    EXPECT_NEAR(static_cast<double>(map.fluence().g), whole, 1e-5 * whole);
    Sequence random(6);
    int on_sun = 0;
    for (int i = 0; i < n; ++i) on_sun += map.sample(random.pair()).radiance.g > 1 ? 1 : 0;
    EXPECT_NEAR(on_sun / double{n}, share, 5 * std::sqrt(share * (1 - share) / n));
  }
}

}  // namespace
}  // namespace dspm
