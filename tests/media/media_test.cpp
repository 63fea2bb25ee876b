// The media's properties at points, their bounds, and what they refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dspm/media/majorants.h"
#include "dspm/media/medium.h"
#include "tests/lights/params.h"
#include "tests/support/near.h"

namespace dspm {
namespace media_test {

using namespace dspm::test;

std::unique_ptr<Medium> medium(const std::string& name, const std::vector<Param>& params,
                               const Matrix4& to_world = {}) {
  return make(medium_plugins(), name, params, MediumContext{Transform(to_world)});
}
std::string errors(const std::string& name, const std::vector<Param>& params) {
  return errors_of(medium_plugins(), name, params, MediumContext{});
}

Param integer(std::string name, int value) {
  return {ParamType::integer, std::move(name), {}, std::vector<int>{value}, {}, {}};
}
Param colour(std::string name, std::vector<float> values) {
  return {ParamType::rgb, std::move(name), {}, std::move(values), {}, {}};
}

TEST(Homogeneous, IsWhatItsParametersSay) {
  const auto fog = medium("homogeneous", {colour("sigma_a", {1, 2, 3}), colour("sigma_s", {4, 5, 6}),
                                          number("scale", 2), number("g", 0.5f), colour("Le", {1, 0, 2})});
  const MediumProperties here = fog->at({3, 4, 5});
  EXPECT_EQ(here.sigma_a, Rgb(2, 4, 6));
  EXPECT_EQ(here.sigma_s, Rgb(8, 10, 12));
  EXPECT_EQ(here.g, 0.5f);
  EXPECT_EQ(here.emitted, Rgb(2, 0, 12));
  EXPECT_EQ(fog->majorant({{0, 0, 0}, {1, 1, 1}}), Rgb(10, 14, 18));
  EXPECT_FALSE(fog->extent());
  EXPECT_TRUE(fog->everywhere());
}

TEST(Homogeneous, TakesMeasuredMedia) {
  const auto cream = medium("homogeneous", {text("preset", "Cream")});
  EXPECT_EQ(cream->at({}).sigma_s, Rgb(7.38f, 5.47f, 3.15f));
  EXPECT_NE(errors("homogeneous", {text("preset", "Creme")}).find("no measured medium \"Creme\""), std::string::npos);
}

TEST(Media, RefuseWhatMakesNoSense) {
  for (const char* name : {"homogeneous", "uniformgrid", "rgbgrid", "cloud"}) {
    EXPECT_NE(errors(name, {number("g", 1)}), "") << name;
    EXPECT_NE(errors(name, {number("scale", -1)}), "") << name;
  }
  for (const char* name : {"uniformgrid", "rgbgrid", "cloud"})
    EXPECT_NE(errors(name, {point("p1", {0, 1, 1})}), "") << name;
  EXPECT_NE(errors("uniformgrid", {}), "") << "without a density";
  EXPECT_NE(errors("uniformgrid", {integer("nx", 2), numbers("density", {1})}), "");
  EXPECT_NE(errors("uniformgrid", {integer("nx", 0), numbers("density", {1})}), "");
  EXPECT_NE(errors("uniformgrid", {numbers("density", {-1})}), "");
  EXPECT_NE(errors("rgbgrid", {integer("nx", 2), colour("sigma_s", {1, 1, 1})}), "");
}

// Linear between the middles of cells, and as if 0 were beyond the outermost.
TEST(UniformGrid, IsLinearInBetween) {
  const auto grid = medium("uniformgrid", {integer("nz", 2), numbers("density", {1, 3})});
  const auto at = [&](float x, float y, float z) { return grid->at({x, y, z}).sigma_s.r; };
  EXPECT_NEAR(at(0.5f, 0.5f, 0.25f), 1, 1e-6f);
  EXPECT_NEAR(at(0.5f, 0.5f, 0.5f), 2, 1e-6f);
  EXPECT_NEAR(at(0.5f, 0.5f, 0.75f), 3, 1e-6f);
  EXPECT_NEAR(at(0.5f, 0.5f, 0), 0.5f, 1e-6f);
  EXPECT_NEAR(at(0, 0.5f, 0.25f), 0.5f, 1e-6f);
  EXPECT_EQ(at(0.5f, 0.5f, 1.01f), 0);
}

TEST(UniformGrid, LiesWhereItIsPlaced) {
  const auto grid = medium("uniformgrid", {numbers("density", {1}), point("p0", {-1, -1, -1})},
                           Matrix4::translate(10, 0, 0) * Matrix4::rotate(90, 0, 0, 1) * Matrix4::scale(2, 1, 1));
  expect_near(grid->extent()->low, {9, -2, -1});
  expect_near(grid->extent()->high, {11, 2, 1});
  EXPECT_NEAR(grid->at({10, 0, 0}).sigma_s.r, 1, 1e-6f);
  EXPECT_NEAR(grid->at({10, 1, 0}).sigma_s.r, 0.75f, 1e-5f);
}

// The radiance of 6500 K at a peak of 1 is white, and its luminance that of the spectrum's sum.
TEST(UniformGrid, GlowsByItsTemperature) {
  const auto flame = [&](float temperature, float scale) {
    return medium("uniformgrid", {numbers("density", {1}), numbers("temperature", {temperature}),
                                  numbers("Lescale", {scale}), number("temperatureoffset", 500)})
        ->at({0.5f, 0.5f, 0.5f})
        .emitted;
  };
  const Rgb daylight = flame(7000, 1), ember = flame(2000, 1);
  EXPECT_NEAR(daylight.r / daylight.b, 1, 0.1f);
  EXPECT_GT(ember.r, 3 * ember.b);
  EXPECT_NEAR(luminance(daylight), 100, 7) << "nearly the integral of the observer";
  EXPECT_EQ(flame(7000, 2), daylight * 2);
  EXPECT_EQ(flame(550, 1), Rgb());
}

TEST(RgbGrid, HasColours) {
  const auto grid = medium("rgbgrid", {integer("nx", 2), colour("sigma_s", {1, 0, 0, 0, 0, 3}),
                                       colour("sigma_a", {0, 0, 0, 0, 2, 0}), number("scale", 10)});
  const MediumProperties left = grid->at({0.25f, 0.5f, 0.5f}), right = grid->at({0.75f, 0.5f, 0.5f});
  EXPECT_EQ(left.sigma_s, Rgb(10, 0, 0));
  EXPECT_EQ(right.sigma_s, Rgb(0, 0, 30));
  EXPECT_EQ(right.sigma_a, Rgb(0, 20, 0));
}

TEST(Cloud, IsDenseBelowAndFrayedAbove) {
  const auto cloud = medium("cloud", {});
  double below = 0, above = 0;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  constexpr int kPoints = 2000;
  for (int i = 0; i < kPoints; ++i) {
    const float x = uniform(random), z = uniform(random), y = uniform(random) / 4;
    below += static_cast<double>(cloud->at({x, y, z}).sigma_s.r) / kPoints;
    above += static_cast<double>(cloud->at({x, 1 - y, z}).sigma_s.r) / kPoints;
  }
  EXPECT_GT(below, 0.6);
  EXPECT_LT(above, 0.3);
}

// No point of a box is denser than its majorant, wherever the medium is placed.
TEST(Media, StayBelowTheirMajorants) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<float> density(5 * 4 * 3), colours(3 * 5 * 4 * 3);
  for (float& each : density) each = uniform(random);
  for (float& each : colours) each = uniform(random);
  const std::vector<Param> counts{integer("nx", 5), integer("ny", 4), integer("nz", 3)};
  const auto with = [&](std::vector<Param> more) {
    more.insert(more.end(), counts.begin(), counts.end());
    return more;
  };
  const Matrix4 place = Matrix4::translate(1, 2, 3) * Matrix4::rotate(30, 1, 2, 3) * Matrix4::scale(3, 2, 1);
  for (const auto& each : {medium("uniformgrid", with({numbers("density", density)}), place),
                           medium("rgbgrid", with({colour("sigma_s", colours), colour("sigma_a", colours)}), place),
                           medium("cloud", {}, place)}) {
    const Bounds3 all = *each->extent();
    for (int i = 0; i < 300; ++i) {
      const auto point_in = [&](const Bounds3& box) {
        const Vec3 size = box.extent();
        return box.low + Vec3{size.x * uniform(random), size.y * uniform(random), size.z * uniform(random)};
      };
      Bounds3 box;
      box.add(point_in(all)), box.add(point_in(all));
      const Rgb most = each->majorant(box);
      for (int j = 0; j < 20; ++j) {
        const Rgb here = each->at(point_in(box)).sigma_t();
        for (int c = 0; c < 3; ++c) EXPECT_LE(here[c], most[c] * 1.00001f);
      }
    }
  }
}

// A grid has a place in no box without bounds, so beside a state that fills all space it is asked for its own part alone.
TEST(Media, HaveMajorantsBesideAStateThatFillsAllSpace) {
  const auto fog = medium("homogeneous", {colour("sigma_a", {.1f, .1f, .1f}), colour("sigma_s", {.2f, .2f, .2f})});
  const Matrix4 place = Matrix4::translate(1, 2, 3) * Matrix4::rotate(30, 1, 2, 3);
  for (const auto& grid :
       {medium("uniformgrid", {integer("nx", 2), numbers("density", {3, 9})}, place), medium("cloud", {}, place)}) {
    const Medium* const states[] = {fog.get(), grid.get()};
    const Majorants both(states);
    TentativeCollisions collisions(both, {{0, 0, 0}, {0, 0, 1}}, TentativeCollisions::kLargest, Palette::rgb());
    ASSERT_TRUE(collisions.advance(kInfinity, [] { return 0.5f; }));
    const Rgb most = grid->majorant(*grid->extent());
    for (int c = 0; c < 3; ++c) EXPECT_GE(collisions.majorant()[c], std::max(0.3f, most[c]));
    EXPECT_GT(max_component(most), 0.3f);
  }
}

}  // namespace media_test
}  // namespace dspm
