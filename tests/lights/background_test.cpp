// What the camera sees of a light from infinity where that is not its light.
#include "dspm/lights/background.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lights/density.h"
#include "tests/lights/named_lights.h"

namespace dspm {
namespace {

using namespace dspm::test;

const Param kPortalParam{
    ParamType::point3, "portal", {}, std::vector<float>{-1, -1, 1, -1, 1, 1, 1, 1, 1, 1, -1, 1}, {}, {}};

TEST(Background, IsOfOneColour) {
  const auto sky =
      make_light("infinite", {rgb("L", {3, 2, 1}), rgb("background", {.1f, .2f, .3f})}, around_the_scene());
  const Ray ray{{}, normalize(Vec3{1, 2, 3})};
  EXPECT_EQ(sky->background(ray), Rgb(.1f, .2f, .3f));
  EXPECT_EQ(sky->escaped(ray), Rgb(3, 2, 1));
  EXPECT_NEAR(sky->escaped_pdf_w(ray), 1 / (4 * kPi), 1e-5f);
}

TEST(Background, IsTheLightIfNothingIsSaid) {
  const auto sky = make_light("infinite", {rgb("L", {3, 2, 1})}, around_the_scene());
  EXPECT_EQ(sky->background({{}, {0, 0, 1}}), Rgb(3, 2, 1));
}

TEST(Background, OfAPortalIsSeenThroughIt) {
  const auto window =
      make_light("infinite", {rgb("L", {3, 2, 1}), rgb("background", {0, 0, 0}), kPortalParam}, around_the_scene());
  EXPECT_EQ(window->background({{}, {0, 0, 1}}), Rgb());
  EXPECT_GT(window->escaped({{}, {0, 0, 1}}).r, 2.9f);
  const auto grey = make_light("infinite", {rgb("background", {1, 1, 1}), kPortalParam}, around_the_scene());
  EXPECT_EQ(grey->background({{}, {0, 0, 1}}), Rgb(1));
  EXPECT_EQ(grey->background({{}, {0, 0, -1}}), Rgb());
}

// One bright pixel becomes a Gaussian; all of its light is still there.
TEST(Background, BlurIsAGaussian) {
  Image image(256, 128);
  const int x = 100, y = 50;
  image.at(x, y) = Rgb(5000);
  const EnvironmentMap sharp(image, SphereMapping::equirectangular);
  constexpr float kSigma = 10;
  const EnvironmentMap soft = blurred(image, SphereMapping::equirectangular, kSigma);
  EXPECT_NEAR(soft.fluence().g / sharp.fluence().g, 1, 0.03f);
  const Vec3 middle = direction_at(SphereMapping::equirectangular, {(x + 0.5f) / 256, (y + 0.5f) / 128});
  const Basis basis = Basis::around(middle);
  const float peak = sharp.fluence().g / (2 * kPi * std::pow(kSigma * kPi / 180, 2.f));
  for (const float degrees : {0.f, 5.f, 10.f, 20.f}) {
    float mean = 0;
    for (int i = 0; i < 16; ++i) {
      const float t = degrees * kPi / 180, phi = kPi * static_cast<float>(i) / 8;
      mean +=
          soft.radiance(basis.to_world({std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), std::cos(t)})).g / 16;
    }
    EXPECT_NEAR(mean, peak * std::exp(-degrees * degrees / (2 * kSigma * kSigma)), 0.08f * peak) << degrees;
  }
}

TEST(Background, OfOneRadianceStaysAsItIs) {
  const Image image = [] {
    Image grey(33, 33);
    for (Rgb& pixel : grey.pixels) pixel = Rgb(.5f);
    return grey;
  }();
  for (const float sigma : {1.f, 30.f, 90.f})
    EXPECT_NEAR(blurred(image, SphereMapping::equal_area, sigma).radiance(normalize(Vec3{1, -2, .5f})).g, .5f, 1e-4f);
}

TEST(Background, SaysWhatIsWrong) {
  const auto said = [](std::vector<Param> params) {
    return errors_of(light_plugins(), "infinite", std::move(params), around_the_scene());
  };
  EXPECT_NE(said({number("backgroundblur", 5)}).find("no image"), std::string::npos);
  EXPECT_NE(said({number("backgroundblur", 500)}).find("90 degrees"), std::string::npos);
  EXPECT_NE(said({number("backgroundblur", 5), rgb("background", {1, 1, 1})}).find("not both"), std::string::npos);
}

}  // namespace
}  // namespace dspm
