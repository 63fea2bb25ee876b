// Transparent images as files hold them, over backgrounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "dspm/image/encoding.h"
#include "dspm/image/png.h"
#include "dspm/output/view.h"

namespace dspm {
namespace cut_out_test {

const std::array<Rgb, 3> kBackgrounds = {Rgb(1), Rgb(), Rgb(1, 0, 0)};

View named(const std::string& name, std::optional<Rgb> background = std::nullopt) {
  return View(ViewSettings{.view = name, .background = background});
}

Image one_pixel(const Rgb& radiance, float alpha) {
  Image image(1, 1);
  image.at(0, 0) = radiance, image.alpha = {alpha};
  return image;
}

/// In linear light, as a file of eight bits holds it.
Rgb over(const Image& cut_out, const Rgb& background) {
  const Image file = decode_png(png_bytes(cut_out), {});
  const float alpha = file.alpha.empty() ? 1 : file.alpha[0];
  return alpha * file.at(0, 0) + (1 - alpha) * background;
}

float largest_difference(const Rgb& a, const Rgb& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Rounding to eight bits moves linear values by less, at the steep end of sRGB's curve.
constexpr float kRounding = 0.006f;

TEST(CutOut, AnEdgeHasTheColourOfItsSurface) {
  for (const Rgb& surface : {Rgb(0.8f, 0.4f, 0.1f), Rgb(13, 0.5f, 0.5f), Rgb(200)})
    for (const std::string& name : view_names())
      for (const float alpha : {0.02f, 0.1f, 0.3f, 0.5f, 0.99f}) {
        if (alpha < 0.1f && surface.r > 1) continue;  // more than so little alpha explains
        const Image shown = named(name).cut_out(one_pixel(alpha * surface, alpha));
        const Rgb wanted = curved(*view_curve(name), surface);
        EXPECT_LT(largest_difference(shown.at(0, 0), wanted), 1e-5f) << name << " " << alpha;
        EXPECT_NEAR(shown.alpha[0], alpha, 1e-6f) << name;
      }
}

/// The reference is the render before that background.
TEST(CutOut, EdgesAreRightOverWhiteBlackAndRed) {
  for (const Rgb& surface : {Rgb(0.5f), Rgb(0.9f, 0.2f, 0.05f), Rgb(0.02f, 0.1f, 0.7f), Rgb()})
    for (const Rgb& background : kBackgrounds)
      for (const float alpha : {0.f, 0.1f, 0.25f, 0.5f, 0.8f, 1.f}) {
        const Rgb light = alpha * surface;
        const Rgb is = over(named("standard").cut_out(one_pixel(light, alpha)), background);
        EXPECT_LT(largest_difference(is, light + (1 - alpha) * background), kRounding) << alpha;
      }
}

/// No dark line around something bright on a white page.
TEST(CutOut, EdgesOnWhiteAreNotDarkerThanWhatTheyPart) {
  for (const std::string& name : view_names())
    for (const float radiance : {1.f, 2.f, 5.f, 20.f}) {
      const float surface = max_component(curved(*view_curve(name), Rgb(radiance)));
      for (float alpha = 0.05f; alpha < 1; alpha += 0.05f) {
        const Rgb is = over(named(name).cut_out(one_pixel(Rgb(alpha * radiance), alpha)), Rgb(1));
        EXPECT_GT(max_component(is), surface - kRounding) << name << " " << radiance << " " << alpha;
      }
    }
}

/// Caustics on a shadow catcher: light where nothing is. Over black it shows as it would without alpha, over white it
/// changes nothing in its brightest component.
TEST(CutOut, LightWithoutASurfaceIsAdded) {
  const Rgb light(0.3f, 0.2f, 0.05f);
  for (const std::string& name : view_names())
    for (const float alpha : {0.f, 1e-4f, 1e-3f}) {
      const Image shown = named(name).cut_out(one_pixel(light, alpha));
      EXPECT_LT(largest_difference(over(shown, Rgb()), curved(*view_curve(name), light)), 0.02f)
          << name << " " << alpha;
      EXPECT_NEAR(over(shown, Rgb(1)).r, 1, 0.02f) << name << " " << alpha;
    }
}

TEST(CutOut, AShadowIsBlackWithItsAlpha) {
  const Image shown = named("agx").cut_out(one_pixel(Rgb(), 0.4f));
  EXPECT_LT(max_component(shown.at(0, 0)), 1e-4f);
  EXPECT_EQ(shown.alpha[0], 0.4f);
}

TEST(CutOut, AlphaOfNoisyFiltersIsClamped) {
  EXPECT_EQ(named("agx").cut_out(one_pixel(Rgb(), -0.1f)).alpha[0], 0);
  EXPECT_EQ(named("agx").cut_out(one_pixel(Rgb(0.5f), 1.1f)).alpha[0], 1);
}

/// Whatever the view makes of radiance 1.
TEST(Background, WhiteStaysWhite) {
  for (const std::string& name : view_names()) {
    const Image shown = named(name, Rgb(1)).shown(one_pixel(Rgb(), 0));
    EXPECT_EQ(shown.at(0, 0), Rgb(1)) << name;
    EXPECT_TRUE(shown.alpha.empty());
    EXPECT_EQ(srgb_bytes(named(name, Rgb(1)).cut_out(one_pixel(Rgb(), 0))), "\xff\xff\xff") << name;
  }
}

TEST(Background, StandsBehindWhatCoversAPart) {
  const Rgb background(0.2f, 0.4f, 0.6f), surface(0.5f);
  const Rgb is = named("neutral", background).shown(one_pixel(0.25f * surface, 0.25f)).at(0, 0);
  EXPECT_LT(largest_difference(is, 0.25f * Rgb(0.46f) + 0.75f * background), 1e-5f);
}

TEST(Background, WithoutOneNothingChanges) {
  Image opaque = one_pixel(Rgb(0.3f), 0.5f);
  opaque.alpha.clear();
  EXPECT_EQ(named("agx").shown(one_pixel(Rgb(0.3f), 0.5f)), named("agx").shown(opaque));
}

TEST(Background, IsWrittenAsOnPages) {
  EXPECT_EQ(parse_background("white"), Rgb(1));
  EXPECT_EQ(parse_background("black"), Rgb());
  EXPECT_NEAR(parse_background("#00bC00").g, srgb_to_linear(0xbc / 255.f), 1e-6);
  EXPECT_EQ(parse_background("#ff0000"), Rgb(1, 0, 0));
  for (const char* const bad : {"", "whit", "#fff", "#-12345", "#12345g", "#1234567", "ffffff"})
    EXPECT_THROW(parse_background(bad), std::runtime_error) << bad;
}

}  // namespace cut_out_test
}  // namespace dspm
