// Mappings of the sphere, and importance sampling of an image on it.
#include "dspm/lights/environment_map.h"

#include <gtest/gtest.h>

#include "tests/lights/density.h"
#include "tests/lights/environment.h"
#include "tests/support/near.h"

namespace dspm {
namespace {

using namespace dspm::test;

constexpr SphereMapping kMappings[] = {SphereMapping::equal_area, SphereMapping::equirectangular};

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

/// Pictures of all sizes and shapes, the smallest among them.
template <class Fn>
void for_each_map(Fn&& fn) {
  for (const SphereMapping mapping : kMappings)
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 2}, {2, 1}, {2, 2}, {3, 3}, {4, 4}, {8, 4}, {7, 5}})
      fn(EnvironmentMap(random_environment(w, h), mapping), std::to_string(w) + " x " + std::to_string(h));
}

// What was drawn is what is seen there, and drawn with the numbers that it says.
TEST(EnvironmentMap, SamplesAreWhatIsSeen) {
  for_each_map([](const EnvironmentMap& map, const std::string& size) {
    if (map.is_black()) return;
    const float whole = luminance(map.fluence());
    Sequence random(5);
    for (int i = 0; i < 2000; ++i) {
      const Vec2 u = random.pair();
      const EnvironmentMap::Sample s = map.sample(u);
      const float scale = std::max(whole / 12, luminance(s.radiance));
      EXPECT_LT(max_component(map.radiance(s.direction) - s.radiance), 1e-4f * scale) << size;
      EXPECT_NEAR(map.pdf_w(s.direction), s.pdf_w, 1e-4f * scale / whole) << size;
      const EnvironmentMap::Sample again = map.sample(map.sample_numbers(s.direction));
      EXPECT_LT(max_component(abs(again.direction - s.direction)), 2e-3f) << size;
    }
  });
}

TEST(EnvironmentMap, SeesPixelsAtTheirCentresAndBlendsThemBetween) {
  for (const SphereMapping mapping : kMappings) {
    const Image image = random_environment(8, 4);
    const EnvironmentMap map(image, mapping);
    const auto at = [&](float x, float y) { return map.radiance(direction_at(mapping, {x / 8, y / 4})); };
    const auto expect = [](const Rgb& a, const Rgb& b) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 2e-4f);
    };
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 8; ++x) expect(at(static_cast<float>(x) + .5f, static_cast<float>(y) + .5f), image.at(x, y));
    const Rgb &a = image.at(2, 1), &b = image.at(3, 1), &c = image.at(2, 2), &d = image.at(3, 2);
    expect(at(2.75f, 2.25f), .25f * (.75f * a + .25f * b) + .75f * (.75f * c + .25f * d));
    if (mapping == SphereMapping::equirectangular) {
      expect(at(0, 1.5f), .5f * (image.at(0, 1) + image.at(7, 1)));
      expect(at(7.75f, 1.5f), .75f * image.at(7, 1) + .25f * image.at(0, 1));
      Rgb pole;
      for (int x = 0; x < 8; ++x) pole += image.at(x, 0) * (1 / 8.f);
      expect(map.radiance({0, 0, 1}), pole);
      expect(at(3.5f, .25f), .5f * (pole + image.at(3, 0)));
    } else {  // edges are folded onto themselves, and all corners are one
      expect(at(0, 1.5f), .5f * (image.at(0, 1) + image.at(0, 2)));
      expect(at(8, 1.5f), .5f * (image.at(7, 1) + image.at(7, 2)));
      expect(at(2.5f, 0), .5f * (image.at(2, 0) + image.at(5, 0)));
      expect(map.radiance({0, 0, -1}), .25f * (image.at(0, 0) + image.at(7, 0) + image.at(0, 3) + image.at(7, 3)));
    }
  }
}

// Along great circles, a step of a thousandth changes radiance by no more than the steepest slope allows: pixels are at
// least a third of 2 / size apart.
TEST(EnvironmentMap, HasNoSteps) {
  for_each_map([](const EnvironmentMap& map, const std::string& size) {
    constexpr float kStep = 1e-3f;
    const float most = 40 * 3 * static_cast<float>(map.size()) / 2;  // of the brightest pixel
    Sequence random(8);
    for (int circle = 0; circle < 10; ++circle) {
      const Basis basis =
          circle == 0 ? Basis{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}} : Basis::around(uniform_sphere(random.pair()));
      Rgb last = map.radiance(basis.x);
      for (float angle = kStep; angle < 2 * kPi; angle += kStep) {
        const Rgb next = map.radiance(basis.x * std::cos(angle) + basis.y * std::sin(angle));
        ASSERT_LT(std::max(max_component(next - last), max_component(last - next)), most * kStep)
            << size << " " << angle;
        last = next;
      }
    }
  });
}

// By the midpoint rule over the sphere.
TEST(EnvironmentMap, FluenceAndIlluminanceAreWhatIsSeen) {
  for_each_map([](const EnvironmentMap& map, const std::string& size) {
    constexpr int kRows = 200;
    double fluence = 0, illuminance = 0, density = 0;
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < 2 * kRows; ++x) {
        const double z = 1 - (y + .5) / kRows * 2, phi = (x + .5) / kRows * M_PI, s = std::sqrt(1 - z * z);
        const Vec3 w{static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                     static_cast<float>(z)};
        const auto light = static_cast<double>(luminance(map.radiance(w)));
        fluence += light, illuminance += light * std::max(z, 0.), density += static_cast<double>(map.pdf_w(w));
      }
    const double cell = 4 * M_PI / (2 * kRows * kRows);
    const auto whole = static_cast<double>(luminance(map.fluence()));
    EXPECT_NEAR(fluence * cell, whole, 1e-3 * whole) << size;
    EXPECT_NEAR(illuminance * cell, static_cast<double>(map.illuminance()), 1e-3 * whole) << size;
    EXPECT_NEAR(density * cell, map.is_black() ? 0 : 1, 1e-3) << size;
  });
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
    // Among its neighbours, too, something of it is seen.
    const double whole = 4 * M_PI + (1e6 - 1) * solid_angle, share = ((1e6 - 1) + 4) * solid_angle / whole;
    EXPECT_NEAR(static_cast<double>(map.fluence().g), whole, 1e-5 * whole);
    Sequence random(6);
    int on_sun = 0;
    for (int i = 0; i < n; ++i) on_sun += map.sample(random.pair()).radiance.g > 1 ? 1 : 0;
    EXPECT_NEAR(on_sun / double{n}, share, 5 * std::sqrt(share * (1 - share) / n));
  }
}

}  // namespace
}  // namespace dspm
