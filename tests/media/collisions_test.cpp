// Tentative collisions along rays through grids of majorants: how deep they lie, and that no part of a ray is left out.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dspm/base/math/sampling.h"
#include "dspm/media/majorants.h"

namespace dspm {
namespace collisions_test {

/// Denser towards larger x, in a box.
class Slope final : public Medium {
 public:
  MediumProperties at(const Vec3& p) const override { return {Rgb(density(p.x), 2 * density(p.x), 0), Rgb(), {}, 0}; }
  Rgb majorant(const Bounds3& box) const override { return {density(box.high.x), 2 * density(box.high.x), 0}; }
  std::optional<Bounds3> extent() const override { return Bounds3{{0, 0, 0}, {4, 2, 1}}; }
  static float density(float x) { return 0.25f * std::clamp(x, 0.f, 4.f); }
};

class Fog final : public Medium {
 public:
  MediumProperties at(const Vec3&) const override { return {Rgb(0.5f), Rgb(), {}, 0}; }
  Rgb majorant(const Bounds3&) const override { return Rgb(0.5f); }
};

Majorants majorants_of(const Medium& medium) {
  const Medium* const states[] = {&medium};
  return Majorants(states);
}

struct Uniform {
  std::mt19937 random{11};
  float operator()() { return std::uniform_real_distribution<float>(0, 0.99999994f)(random); }
};

// The chance to pass all of the way without a real collision is exp(-depth), whatever the way through the cells.
TEST(TentativeCollisions, LeaveTheTransmittance) {
  const Slope slope;
  const Majorants majorants = majorants_of(slope);
  Uniform uniform;
  struct Way {
    Vec3 from, to;
    double depth;  // of red: the integral of the density
  };
  for (const Way& way :
       {Way{{0, 1, 0.5f}, {4, 1, 0.5f}, 2}, Way{{4, 1, 0.5f}, {0, 1, 0.5f}, 2}, Way{{2, 1, 0.5f}, {3, 1, 0.5f}, 0.625},
        Way{{-2, 1, 0.5f}, {6, 1, 0.5f}, 2}, Way{{3, -1, 0.5f}, {3, 1, 0.5f}, 0.75},
        Way{{-1, 3, 0.5f}, {6, 3, 0.5f}, 0}, Way{{0, 0, 0}, {4, 2, 1}, 0.5 * std::sqrt(16 + 4 + 1)}}) {
    const Vec3 along = way.to - way.from;
    const Ray ray{way.from, normalize(along)};
    for (const int colour : {0, 1}) {
      constexpr int kRays = 40'000;
      int passed = 0;
      for (int i = 0; i < kRays; ++i) {
        TentativeCollisions collisions(majorants, ray, colour, Palette::rgb());
        bool collides = false;
        while (!collides && collisions.advance(length(along), uniform))
          collides =
              uniform() * collisions.majorant()[colour] < slope.at(ray.at(collisions.distance())).sigma_t()[colour];
        passed += !collides;
      }
      const double expected = std::exp(-way.depth * (colour + 1)), share = static_cast<double>(passed) / kRays;
      EXPECT_NEAR(share, expected, 4.5 * std::sqrt(expected * (1 - expected) / kRays) + 1e-9)
          << way.from.x << " to " << way.to.x << ", colour " << colour;
    }
  }
}

// The depth that each step reports adds up to the integral of the majorant, in pieces or at once.
TEST(TentativeCollisions, AddUpTheirDepth) {
  const Slope slope;
  const Majorants majorants = majorants_of(slope);
  Uniform uniform;
  for (int i = 0; i < 200; ++i) {
    const Vec3 from{-1 + 6 * uniform(), -1 + 4 * uniform(), -1 + 3 * uniform()};
    const Ray ray{from, uniform_sphere({uniform(), uniform()})};
    const auto depth = [&](float step) {
      Spectrum sum;
      TentativeCollisions collisions(majorants, ray, 0, Palette::rgb());
      for (float end = step; end <= 8; end += step) {
        while (collisions.advance(end, uniform)) sum += collisions.depth();
        sum += collisions.depth();
        EXPECT_EQ(collisions.distance(), end);
      }
      return sum;
    };
    const Spectrum whole = depth(8), pieces = depth(0.25f);
    EXPECT_NEAR(whole[0], pieces[0], 2e-4f) << i;
    EXPECT_NEAR(whole[1], 2 * whole[0], 2e-4f) << i;
    EXPECT_EQ(whole[2], 0) << i;
  }
}

TEST(TentativeCollisions, FillAllSpaceInAMediumWithoutEnd) {
  const Fog fog;
  const Majorants majorants = majorants_of(fog);
  Uniform uniform;
  double sum = 0;
  constexpr int kRays = 20'000;
  for (int i = 0; i < kRays; ++i) {
    TentativeCollisions collisions(majorants, {{5, 6, 7}, {0, 1, 0}}, TentativeCollisions::kLargest, Palette::rgb());
    ASSERT_TRUE(collisions.advance(kInfinity, uniform));
    sum += static_cast<double>(collisions.distance()) / kRays;
  }
  EXPECT_NEAR(sum, 2, 0.06);
}

// Of several states, the bound is that of the densest.
TEST(Majorants, HoldForAllStates) {
  const Slope slope;
  const Fog fog;
  const Medium* const states[] = {&slope, &fog};
  const Majorants both(states);
  EXPECT_TRUE(both.is_everywhere());
  TentativeCollisions collisions(both, {{0, 0, 0}, {1, 0, 0}}, 1, Palette::rgb());
  Uniform uniform;
  ASSERT_TRUE(collisions.advance(kInfinity, uniform));
  EXPECT_EQ(collisions.majorant(), Spectrum(1, 2, 0.5f));
}

}  // namespace collisions_test
}  // namespace dspm
