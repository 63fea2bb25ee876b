// Parameters of the lights that have no shape: units, defaults and errors; and what does not need statistics.
#include <gtest/gtest.h>

#include "dspm/lights/sun_disk.h"
#include "tests/lights/density.h"
#include "tests/lights/environment.h"
#include "tests/lights/lamps.h"
#include "tests/support/near.h"

namespace dspm {
namespace {

using namespace dspm::test;

TEST(Point, FallsOffWithTheSquareOfTheDistance) {
  const auto light = make_light("point", {rgb("I", {8, 4, 2}), point("from", {0, 0, 2}), number("scale", 2)}, {});
  const Illumination l = light->illuminate({0, 0, 0}, {}).value();
  EXPECT_EQ(l.radiance, Rgb(4, 2, 1));
  EXPECT_EQ(l.distance, 2);
  EXPECT_EQ(l.wi, (Vec3{0, 0, 1}));
  EXPECT_EQ(l.pdf_w, 0);
  EXPECT_FALSE(light->illuminate({0, 0, 2}, {}));
}

TEST(Point, PowerIsInLumen) {
  EXPECT_NEAR(luminance(make_light("point", {number("power", 700)}, {})->power()), 700, 1e-3f);
  const auto green = make_light("point", {number("power", 700), rgb("I", {0, 1, 0})}, {});
  EXPECT_NEAR(green->power().g, 700, 1e-3f);  // as in pbrt, I itself is not normalised
}

// 3 x^2 - 2 x^3 between the cones, x linear in the cosine.
TEST(Spot, FallsOffAsPbrtSays) {
  LightContext context;
  context.to_world = Transform(Matrix4::translate(5, 0, 0) * Matrix4::rotate(90, 0, 1, 0));  // +z becomes +x
  const auto light = make_light("spot", {number("coneangle", 50), number("conedeltaangle", 20)}, context);
  const float cos_end = std::cos(kPi * 50 / 180), cos_start = std::cos(kPi * 30 / 180);
  for (int degrees = 0; degrees < 90; degrees += 3) {
    const float angle = kPi * static_cast<float>(degrees) / 180;
    const auto l = light->illuminate({5 + 2 * std::cos(angle), 2 * std::sin(angle), 0}, {});
    const float x = std::clamp((std::cos(angle) - cos_end) / (cos_start - cos_end), 0.f, 1.f);
    EXPECT_NEAR(l ? l->radiance.g : 0, x * x * (3 - 2 * x) / 4, 2e-6f) << degrees;
  }
}

TEST(Spot, PowerIsInLumen) {
  for (const float angle : {0.1f, 5.f, 80.f, 180.f})
    EXPECT_NEAR(
        luminance(make_light("spot",
                             {number("coneangle", angle), number("conedeltaangle", angle / 2), number("power", 700)},
                             {})
                      ->power()),
        700, 1e-3f);
}

TEST(Spot, PhotonsStayWithinTheConeAndCarryTheSame) {
  const auto light = make_light("spot", {number("coneangle", 20), number("conedeltaangle", 15)}, {});
  Sequence random(1);
  for (int i = 0; i < 10'000; ++i) {
    const Emission e = light->emit({}, random.pair()).value();
    EXPECT_GT(e.ray.direction.z, std::cos(kPi * 20.01f / 180));
    EXPECT_EQ(e.flux, light->power());
  }
  for (const Vec2 u : {Vec2{0, 0}, Vec2{0x1.fffffep-1f, 0x1.fffffep-1f}, Vec2{0x1p-24f, 0}})
    EXPECT_TRUE(is_finite(light->emit({}, u).value().ray.direction));
}

TEST(Distant, ShinesAlongFromTo) {
  LightContext context;
  context.to_world = Transform(Matrix4::rotate(90, 0, 0, 1));  // +x becomes +y
  context.scene_radius = 2;
  const auto light =
      make_light("distant", {point("from", {3, 0, 0}), point("to", {1, 0, 0}), number("illuminance", 9)}, context);
  const Illumination l = light->illuminate({7, 8, 9}, {}).value();
  expect_near(l.wi, {0, 1, 0});
  EXPECT_EQ(l.distance, kInfinity);
  EXPECT_EQ(l.radiance, Rgb(9));
  EXPECT_NEAR(light->power().g, 9 * 4 * kPi, 1e-4f);
}

// The mean of 1 / pdf_w is the solid angle, and that of cos / pdf_w what a face gets.
TEST(Distant, IsAsBrightAsADisk) {
  for (const float angle : {kLeastSunAngle, 0.53f, 20.f, 180.f}) {
    const auto light = make_light("distant", {rgb("L", {3, 2, 1}), number("angle", angle)}, {});
    const double half = static_cast<double>(angle) * M_PI / 360,
                 solid_angle = 4 * M_PI * std::pow(std::sin(half / 2), 2);
    Sequence random(3);
    double received = 0;
    constexpr int kSamples = 100'000;
    for (int i = 0; i < kSamples; ++i) {
      const Illumination l = light->illuminate({}, random.pair()).value();
      EXPECT_NEAR(l.pdf_w * solid_angle, 1, 1e-5) << angle;
      received -= static_cast<double>(l.radiance.r * l.wi.z / l.pdf_w) / kSamples;
      EXPECT_LT(std::asin(length(cross(l.wi, Vec3{0, 0, 1}))), half * 1.002) << angle;
    }
    EXPECT_NEAR(received, 3, 0.025) << angle;
    const auto seen_at = [&](double share) {  // of the way to the rim
      const auto a = static_cast<float>(half * share);
      return light->escaped({{}, {std::sin(a), 0, -std::cos(a)}});
    };
    EXPECT_NEAR(seen_at(0.99).g * std::pow(std::sin(half), 2) * M_PI, 2, 1e-4) << angle;
    EXPECT_EQ(seen_at(1.01), Rgb()) << angle;
  }
}

TEST(Infinite, ConstantIsTheSameEverywhere) {
  LightContext context;
  context.scene_radius = 2;
  const auto light = make_light("infinite", {rgb("L", {1, 2, 3}), number("scale", 2)}, context);
  Sequence random(2);
  for (int i = 0; i < 1000; ++i) {
    const Illumination l = light->illuminate({}, random.pair()).value();
    EXPECT_EQ(l.radiance, Rgb(2, 4, 6));
    EXPECT_NEAR(l.pdf_w, 1 / (4 * kPi), 1e-6f);
    EXPECT_EQ(light->escaped({{}, l.wi}), l.radiance);
    EXPECT_NEAR(light->escaped_pdf_w({{}, l.wi}), l.pdf_w, 1e-6f);
  }
  EXPECT_NEAR(light->power().g, 4 * (4 * kPi) * (4 * kPi),
              1e-2f);  // L times the disk's area times the sphere of directions
  const auto lux = make_light("infinite", {number("illuminance", 5)}, {});
  EXPECT_NEAR(lux->escaped({{}, {0, 0, 1}}).g, 5 / kPi, 1e-6f);
}

// An image is turned with its light; illuminance is what faces +z of the light gets.
TEST(Infinite, ImagesAreTurnedAndScaled) {
  Image image(128, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      const float column = static_cast<float>(x), row = static_cast<float>(y);
      const bool upper = std::abs(column - 63.5f) + std::abs(row - 63.5f) < 64;
      image.at(x, y) = {column, row, upper ? 1.f : 0.f};
    }
  const EnvironmentFile file(image);
  LightContext context;
  context.to_world = Transform(Matrix4::rotate(-90, 1, 0, 0));  // +z becomes +y
  const auto light = make_light("infinite", {text("filename", file.path()), number("scale", 2)}, context);
  EXPECT_EQ(light->escaped({{}, normalize({0, 1, 0.05f})}).b, 2);  // the upper hemisphere is the inner diamond
  EXPECT_EQ(light->escaped({{}, normalize({0, -0.05f, 1})}).b, 0);
  EXPECT_GT(light->escaped({{}, normalize({1, 0.01f, 0})}).r, 2 * 125);  // +x is the right edge's middle

  const auto lux = make_light("infinite", {text("filename", file.path()), number("illuminance", 5)}, context);
  double sum = 0;
  Sequence random(3);
  for (int i = 0; i < 100'000; ++i) {
    const Illumination l = lux->illuminate({}, random.pair()).value();
    sum += static_cast<double>(luminance(l.radiance) * std::max(0.f, l.wi.y) / l.pdf_w);
  }
  EXPECT_NEAR(sum / 1e5, 5, 0.05);
}

TEST(Infinite, SamplesFollowEscapedPdfWUnderAnyTransform) {
  const EnvironmentFile file(7, 7);
  for (const Matrix4& m : {Matrix4::rotate(50, 3, 2, 1), Matrix4::scale(-1, 1, 1),
                           Matrix4::rotate(50, 3, 2, 1) * Matrix4::scale(1, 2, .7)}) {
    LightContext context;
    context.to_world = Transform(m);
    const auto light = make_light("infinite", {text("filename", file.path())}, context);
    DensityComparison comparison;
    comparison.add_samples(
        200'000, [&](Sequence& random) { comparison.sample(light->illuminate({}, random.pair()).value().wi); });
    comparison.add_claims(200'000, [&](const Vec3& w) { return light->escaped_pdf_w({{}, w}); });
    EXPECT_GT(comparison.p_value(), 0.001);
    EXPECT_LT(comparison.deviation(), 4);
  }
}

TEST(Infinite, BlackOrSpoiltImagesGiveNoLight) {
  Image image(4, 4);
  for (Rgb& pixel : image.pixels) pixel = {-1, std::nanf(""), kInfinity};
  const EnvironmentFile file(image);
  Diagnostics diagnostics;
  const auto light = make(light_plugins(), "infinite", {text("filename", file.path())}, LightContext{}, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_NE(to_string(diagnostics.all()[0]).find("pixel 0, 0 is not finite, nor are 15 more"), std::string::npos);
  EXPECT_TRUE(is_black(light->power()));
  EXPECT_FALSE(light->emit({}, {}));
  EXPECT_FALSE(light->illuminate({}, {}));
  EXPECT_EQ(light->escaped({{}, {0, 0, 1}}), Rgb());
}

// Frames whose lights are multiples of one another share photons, so a light of another place or shape must not count
// as one.
TEST(Lights, AreMultiplesOnlyOfLightsOfTheSamePlaceAndShape) {
  const auto spot = [](float angle, float delta, Vec3 from, Vec3 to, float intensity) {
    return make_light("spot",
                      {number("coneangle", angle), number("conedeltaangle", delta), point("from", from),
                       point("to", to), rgb("I", Rgb(intensity))},
                      {});
  };
  const auto light = spot(40, 10, {}, {0, 0, 1}, 2);
  EXPECT_EQ(spot(40, 10, {}, {0, 0, 1}, 6)->ratio_to(*light), Rgb(3));
  EXPECT_FALSE(spot(50, 20, {}, {0, 0, 1}, 2)->ratio_to(*light));  // the same inner cone
  EXPECT_FALSE(spot(40, 20, {}, {0, 0, 1}, 2)->ratio_to(*light));  // the same outer cone
  EXPECT_FALSE(spot(40, 10, {0, 0, -1}, {0, 0, 1}, 2)->ratio_to(*light));
  EXPECT_FALSE(spot(40, 10, {}, {0, 1, 1}, 2)->ratio_to(*light));

  const auto bulb = make_light("point", {rgb("I", Rgb(2))}, {});
  EXPECT_EQ(make_light("point", {rgb("I", {2, 4, 8})}, {})->ratio_to(*bulb), Rgb(1, 2, 4));
  EXPECT_FALSE(make_light("point", {point("from", {0, 1, 0})}, {})->ratio_to(*bulb));
  EXPECT_FALSE(bulb->ratio_to(*light));

  const auto sun = make_light("distant", {}, {});
  EXPECT_EQ(make_light("distant", {rgb("L", Rgb(4))}, {})->ratio_to(*sun), Rgb(4));
  EXPECT_FALSE(make_light("distant", {point("to", {0, 1, 1})}, {})->ratio_to(*sun));
  const auto disk = make_light("distant", {number("angle", 2)}, {});
  EXPECT_EQ(make_light("distant", {number("angle", 2), rgb("L", Rgb(4))}, {})->ratio_to(*disk), Rgb(4));
  EXPECT_FALSE(make_light("distant", {number("angle", 3)}, {})->ratio_to(*disk));
  EXPECT_FALSE(disk->ratio_to(*sun));

  LightContext turned;
  turned.to_world = Transform(Matrix4::rotate(90, 1, 0, 0));
  const auto sky = make_light("infinite", {}, {});
  EXPECT_EQ(make_light("infinite", {rgb("L", Rgb(5))}, {})->ratio_to(*sky), Rgb(5));
  EXPECT_FALSE(make_light("infinite", {}, turned)->ratio_to(*sky));
}

TEST(Lights, RejectWhatMakesNoSense) {
  const auto errors = [](const std::string& name, std::vector<Param> params) {
    return errors_of(light_plugins(), name, std::move(params), LightContext{});
  };
  EXPECT_EQ(errors("point", {number("scale", -1)}), "parameter \"scale\" of plugin \"point\" must not be negative\n");
  EXPECT_NE(errors("spot", {number("coneangle", 0)}), "");
  EXPECT_NE(errors("spot", {number("coneangle", 10), number("conedeltaangle", 11)}), "");
  EXPECT_NE(errors("distant", {point("from", {0, 0, 1})}), "");
  for (const float angle : {-1.f, 0.005f, 181.f})
    EXPECT_EQ(errors("distant", {number("angle", angle)}),
              "parameter \"angle\" of plugin \"distant\" must be 0, or lie in 0.01..180\n");
  EXPECT_NE(errors("infinite", {text("filename", "/nowhere/at/all.exr")}), "");
  EXPECT_NE(errors("infinite", {text("mapping", "cubemap")}), "");
  EXPECT_NE(errors("infinite", {point("portal", {})}), "");
  const EnvironmentFile square(4, 4), odd(5, 3);
  EXPECT_NE(errors("infinite", {text("filename", square.path()), rgb("L", Rgb(1))}), "");
  EXPECT_NE(errors("infinite", {text("filename", odd.path())}), "");
  EXPECT_EQ(errors("infinite", {text("filename", odd.path()), text("mapping", "equirectangular")}), "");
  EXPECT_NE(errors("infinite", {text("filename", odd.path()), text("mapping", "equalarea")}), "");
  EXPECT_EQ(errors("infinite", {text("filename", square.path()), text("mapping", "equirectangular")}), "");
}

TEST(Lights, DescribeTheirParameters) {
  for (const auto& plugin : light_plugins()) EXPECT_GE(describe(plugin, LightContext{}).size(), 4u) << plugin.name;
  for (const auto& plugin : area_light_plugins()) EXPECT_EQ(describe(plugin, LightContext{}).size(), 5u) << plugin.name;
}

}  // namespace
}  // namespace dspm
