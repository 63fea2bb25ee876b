// The light of media that glow, as photon paths start from it.
#include "dspm/world/lighting/medium_glow.h"

#include <gtest/gtest.h>

#include <random>

namespace dspm {
namespace medium_glow_test {

/// Brighter with x, in a part of the box.
class Flame final : public Medium {
 public:
  MediumProperties at(const Vec3& p) const override {
    const bool burns = p.x > 0 && p.x < 1 && p.y > 0.3f && p.y < 1 && p.z > 0 && p.z < 2;
    return burns ? MediumProperties{Rgb(p.x), Rgb(), Rgb(p.x, 2 * p.x, p.z), 0} : MediumProperties{};
  }
  Rgb majorant(const Bounds3& box) const override { return box.high.x > 0 && box.low.x < 1 ? Rgb(1) : Rgb(); }
  std::optional<Bounds3> extent() const override { return Bounds3{{0, 0, 0}, {1, 1, 2}}; }
  bool glows() const override { return true; }
};

// The mean flux is 4 pi times the integral of what is emitted, and so are its moments; the power is near it.
TEST(MediumGlow, StartsPathsWhereItIsBright) {
  const MediumGlow glow(std::make_shared<const Flame>(), {{-1, 0, 0}, {1, 1, 2}});
  const double expected[] = {0.5 * 0.7 * 2, 0.7 * 2, 0.7 * 2}, of_x[] = {0.7 * 2 / 3, 2 * 0.7 * 2 / 3, 0.7};
  const double of_z[] = {0.5 * 0.7 * 2, 0.7 * 2, 0.7 * 8 / 3};
  constexpr double kFourPi = 12.566370614;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(static_cast<double>(glow.power()[c]) / (kFourPi * expected[c]), 1, 0.1);

  constexpr int kPaths = 400'000;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> draw(0, (1 << 24) - 1);
  const auto number = [&] { return static_cast<float>(draw(random)) * 0x1p-24f; };
  double flux[3]{}, x[3]{}, z[3]{};
  Vec3 direction;
  int dark = 0;
  for (int i = 0; i < kPaths; ++i) {
    const Vec2 position{number(), number()}, towards{number(), number()};
    const auto start = glow.emit(position, towards);
    if (!start) {
      ++dark;
      continue;
    }
    const Vec3& p = start->ray.origin;
    direction += start->ray.direction / kPaths;
    for (int c = 0; c < 3; ++c) {
      const double share = static_cast<double>(start->flux[c]) / (kFourPi * kPaths);
      flux[c] += share, x[c] += share * static_cast<double>(p.x), z[c] += share * static_cast<double>(p.z);
    }
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(flux[c] / expected[c], 1, 0.01);
    EXPECT_NEAR(x[c] / of_x[c], 1, 0.01);
    EXPECT_NEAR(z[c] / of_z[c], 1, 0.01);
  }
  EXPECT_LT(dark, kPaths / 20);
  EXPECT_LT(length(direction), 0.01f);
}

TEST(MediumGlow, OfNothingStartsNone) {
  const MediumGlow glow(std::make_shared<const Flame>(), {{5, 5, 5}, {6, 6, 6}});
  EXPECT_EQ(glow.power(), Rgb());
  EXPECT_FALSE(glow.emit({0.5f, 0.5f}, {0.5f, 0.5f}));
}

}  // namespace medium_glow_test
}  // namespace dspm
