#include "dspm/output/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "dspm/image/encoding.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace view_test {

Rgb one_pixel(const View& view, const Rgb& radiance) {
  Image image(1, 1);
  image.at(0, 0) = radiance;
  return view.shown(image).at(0, 0);
}

View view_named(const std::string& name, double stops = 0, bool p3 = false) {
  return View(ViewSettings{.view = name, .stops = stops, .display_p3 = p3});
}

TEST(View, StandardClipsComponentsAlone) {
  EXPECT_EQ(one_pixel(view_named("standard"), Rgb(0.25f, 1, 3)), Rgb(0.25f, 1, 1));
  EXPECT_EQ(one_pixel(view_named("standard", -1), Rgb(0.25f, 1, 3)), Rgb(0.125f, 0.5f, 1));
}

TEST(View, EverythingRisesAndStaysWithinOne) {
  for (const auto& [curve, name] : kViewNames) {
    float last = -1;
    for (float radiance = 0; radiance < 1e4f; radiance = radiance * 1.01f + 1e-4f) {
      const float value = curved(curve, Rgb(radiance)).r;
      EXPECT_GE(value, last) << name << " at " << radiance;
      EXPECT_LE(value, 1.f);
      last = value;
    }
    EXPECT_GT(last, 0.98f);
    for (const float bright : {1e30f, std::numeric_limits<float>::infinity()})
      EXPECT_NEAR(curved(curve, Rgb(bright)).r, 1, 1e-2) << name;
    for (const float none : {-1.f, 0.f, std::numeric_limits<float>::quiet_NaN()})
      EXPECT_NEAR(curved(curve, Rgb(none)).r, 0, 1e-3);
  }
}

/// Hable's own numbers: white is at 11.2, and his curve with an exposure of 2 makes of radiance 1 what it makes of 2.
TEST(View, FilmicHasItsWhite) {
  EXPECT_NEAR(curved(ViewCurve::filmic, Rgb(5.6f)).g, 1, 1e-6);
  EXPECT_LT(curved(ViewCurve::filmic, Rgb(5.4f)).g, 1);
  const float film_of_2 = 0.704f / 1.66f - 0.02f / 0.3f, film_of_white = 19.38f / 24.476f - 0.02f / 0.3f;
  EXPECT_NEAR(curved(ViewCurve::filmic, Rgb(1)).g, film_of_2 / film_of_white, 1e-5);
}

TEST(View, AgxPutsGreyInTheMiddleOfTheScale) {
  EXPECT_NEAR(linear_to_srgb(curved(ViewCurve::agx, Rgb(0.18f)).g), 0.5f, 1e-4);
  // Slope 2 on the scale of 16.5 stops: half a stop more is 2 x 0.5 / 16.5.
  EXPECT_NEAR(linear_to_srgb(curved(ViewCurve::agx, Rgb(0.18f * std::sqrt(2.f))).g), 0.5f + 1 / 16.5f, 2e-3);
  EXPECT_NEAR(curved(ViewCurve::agx, Rgb(0.18f * std::exp2(6.5f))).g, 1, 1e-3);
  EXPECT_NEAR(curved(ViewCurve::agx, Rgb(0.18f * std::exp2(-10.f))).g, 0, 1e-4);
}

/// What the other curves do not: bright orange light turns pale step by step, instead of flat orange or yellow.
TEST(View, AgxLetsBrightColoursFade) {
  const auto saturation = [](float stops) {
    const Rgb c = curved(ViewCurve::agx, Rgb(1, 0.35f, 0.05f) * std::exp2(stops));
    return 1 - std::min({c.r, c.g, c.b}) / max_component(c);
  };
  for (float stops = 0; stops < 6; stops += 0.5f) EXPECT_LT(saturation(stops + 0.5f), saturation(stops)) << stops;
  EXPECT_LT(saturation(6), 0.25f);
}

void expect_near(const Rgb& is, const Rgb& wanted, float most) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(is[c], wanted[c], most) << "component " << c;
}

/// Wrensch's polynomial for AgX's sigmoid (its mean squared error is 3.7e-6), a look, and Sobotka's matrices.
Rgb agx_by_polynomial(const Rgb& colour, double slope_g, double slope_b, double power, double saturation) {
  constexpr double kIn[3][3] = {{0.8424790623, 0.0784336, 0.0792237451},
                                {0.0423282423, 0.8784686365, 0.0791661275},
                                {0.0423756549, 0.0784336, 0.8791429738}},
                   kOut[3][3] = {{1.1968790051, -0.0980208811, -0.0990297441},
                                 {-0.0528968518, 1.1519031299, -0.0989611768},
                                 {-0.0529716355, -0.0980434501, 1.1510736726}};
  double v[3], grey = 0;
  for (int i = 0; i < 3; ++i) {
    const double light = kIn[i][0] * colour.r + kIn[i][1] * colour.g + kIn[i][2] * colour.b;
    const double x = std::clamp((std::log2(light) + 12.47393) / 16.5, 0., 1.);
    const double bent = ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232);
    v[i] = std::pow(std::max(bent, 0.) * (i == 0 ? 1 : i == 1 ? slope_g : slope_b), power);
    grey += v[i] * (i == 0 ? 0.2126 : i == 1 ? 0.7152 : 0.0722);
  }
  Rgb encoded;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) encoded[i] += static_cast<float>(kOut[i][j] * (grey + saturation * (v[j] - grey)));
  for (int i = 0; i < 3; ++i) encoded[i] = std::clamp(encoded[i], 0.f, 1.f);
  return encoded;
}

TEST(View, AgxAndItsLooksAreThePublishedOnes) {
  const auto encoded = [](ViewCurve curve, const Rgb& colour) {
    const Rgb c = curved(curve, colour);
    return Rgb(linear_to_srgb(c.r), linear_to_srgb(c.g), linear_to_srgb(c.b));
  };
  for (const float strength : {0.02f, 0.18f, 0.7f, 3.f})
    for (const Rgb& hue : {Rgb(1), Rgb(1, 0.5f, 0.2f), Rgb(0.1f, 0.4f, 1), Rgb(0.3f, 1, 0.2f)}) {
      SCOPED_TRACE(strength);
      const Rgb colour = strength * hue;
      expect_near(encoded(ViewCurve::agx, colour), agx_by_polynomial(colour, 1, 1, 1, 1), 0.012f);
      expect_near(encoded(ViewCurve::agx_punchy, colour), agx_by_polynomial(colour, 1, 1, 1.35, 1.4), 0.02f);
      expect_near(encoded(ViewCurve::agx_golden, colour), agx_by_polynomial(colour, 0.9, 0.5, 0.8, 0.8), 0.02f);
    }
}

/// By hand from its specification: 0.04 is taken off (less in the dark), and compression starts at 0.76.
TEST(View, NeutralIsKhronosPbrNeutral) {
  expect_near(curved(ViewCurve::neutral, Rgb(0.05f)), Rgb(0.015625f), 1e-6f);
  expect_near(curved(ViewCurve::neutral, Rgb(0.5f, 0.3f, 0.2f)), Rgb(0.46f, 0.26f, 0.16f), 1e-6f);
  expect_near(curved(ViewCurve::neutral, Rgb(1)), Rgb(0.869091f), 1e-5f);
  expect_near(curved(ViewCurve::neutral, Rgb(4, 0.5f, 0.1f)), Rgb(0.983256f, 0.382473f, 0.313812f), 1e-5f);
}

/// What it is for: under white surroundings a plastic of a brand's colour sends that colour and mirrors 0.04.
TEST(View, NeutralKeepsBrandColours) {
  for (const Rgb& brand : {Rgb(0.7f, 0.05f, 0.04f), Rgb(0.04f, 0.2f, 0.6f), Rgb(0.75f, 0.4f, 0.06f)})
    expect_near(curved(ViewCurve::neutral, brand + Rgb(0.04f)), brand, 1e-6f);
}

/// By hand from Hill's matrices and fit.
TEST(View, AcesIsHillsFit) {
  expect_near(curved(ViewCurve::aces, Rgb(0.18f)), Rgb(0.10559f), 1e-5f);
  expect_near(curved(ViewCurve::aces, Rgb(1, 0, 0)), Rgb(0.688028f, 0, 0.002639f), 1e-5f);
}

TEST(View, RawIsNotEncoded) {
  EXPECT_EQ(one_pixel(view_named("raw"), Rgb(0.25f, 0.5f, 3)), Rgb(0.25f, 0.5f, 1));
  EXPECT_EQ(view_named("raw").png().space, PngSpace::linear);
  EXPECT_EQ(view_named("raw").for_video().png().space, PngSpace::srgb);
}

/// Display P3's numbers for the colours of sRGB, as other programs compute them: red is (0.9175, 0.2003, 0.1386).
TEST(View, DisplayP3ShowsTheSameColours) {
  const Rgb red = one_pixel(view_named("standard", 0, true), Rgb(1, 0, 0)),
            grey = one_pixel(view_named("agx", 0, true), Rgb(0.3f));
  EXPECT_NEAR(linear_to_srgb(red.r), 0.9175f, 1e-3);
  EXPECT_NEAR(linear_to_srgb(red.g), 0.2003f, 1e-3);
  EXPECT_NEAR(linear_to_srgb(red.b), 0.1386f, 1e-3);
  EXPECT_NEAR(grey.r, one_pixel(view_named("agx"), Rgb(0.3f)).r, 1e-4);
}

TEST(View, ExposureIsInStops) {
  EXPECT_EQ(one_pixel(view_named("agx", 2), Rgb(0.1f, 0.2f, 0.3f)),
            one_pixel(view_named("agx"), Rgb(0.4f, 0.8f, 1.2f)));
}

TEST(View, UnknownOnesAreRefusedByName) {
  try {
    view_named("agxx");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "there is no view \"agxx\"; there are standard, filmic, agx, agx-punchy, agx-golden, neutral, "
                 "aces, raw, ocio and ocio:DISPLAY/VIEW");
  }
}

/// A configuration whose one view doubles the light and stores its square root.
constexpr const char* kConfiguration = R"(ocio_profile_version: 1
search_path: luts
roles:
  default: raw
  scene_linear: Linear
displays:
  screen:
    - !<View> {name: Twice, colorspace: twice}
    - !<View> {name: None, colorspace: Linear}
active_displays: [screen]
active_views: [Twice, None]
colorspaces:
  - !<ColorSpace>
    name: raw
    isdata: true
  - !<ColorSpace>
    name: Linear
    isdata: false
  - !<ColorSpace>
    name: twice
    isdata: false
    from_reference: !<GroupTransform>
      children:
        - !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
        - !<ExponentTransform> {value: [0.5, 0.5, 0.5, 1]}
)";

/// One that tells where ACES is, works in Rec. 709 at half the brightness, and has a view of data.
constexpr const char* kAcesConfiguration = R"(ocio_profile_version: 1
roles:
  default: raw
  aces_interchange: ACES
  scene_linear: half
displays:
  screen:
    - !<View> {name: Numbers, colorspace: raw}
    - !<View> {name: Light, colorspace: light}
colorspaces:
  - !<ColorSpace>
    name: raw
    isdata: true
  - !<ColorSpace>
    name: light
    isdata: false
  - !<ColorSpace>
    name: ACES
    isdata: false
    to_reference: !<MatrixTransform> {matrix: [2.52169, -1.13413, -0.38756, 0, -0.27648, 1.37272, -0.09624, 0,
                                             -0.01538, -0.15298, 1.16835, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: half
    isdata: false
    from_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
)";

/// The configuration that $OCIO names.
class Configuration {
 public:
  explicit Configuration(const char* text) {
    std::ofstream(directory_ / "config.ocio") << text;
    setenv("OCIO", (directory_ / "config.ocio").c_str(), 1);
  }
  ~Configuration() { unsetenv("OCIO"); }
  Configuration(const Configuration&) = delete;
  Configuration& operator=(const Configuration&) = delete;

 private:
  test::TemporaryDirectory directory_;
};

bool is_built_with_ocio() {
  const Configuration configuration(kConfiguration);
  try {
    view_named("ocio");
  } catch (const std::runtime_error& error) {
    if (std::string(error.what()).find("built without") != std::string::npos) return false;
    throw;
  }
  return true;
}

class Ocio : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_built_with_ocio()) GTEST_SKIP() << "SKIPPED: needs libopencolorio-dev and -DDSPM_OCIO=ON";
  }
};

TEST_F(Ocio, FollowsTheConfiguration) {
  const Configuration configuration(kConfiguration);
  EXPECT_NEAR(linear_to_srgb(one_pixel(view_named("ocio"), Rgb(0.125f)).g), 0.5f, 1e-4);
  EXPECT_NEAR(linear_to_srgb(one_pixel(view_named("ocio:screen/None"), Rgb(0.125f)).g), 0.125f, 1e-4);
  EXPECT_NEAR(linear_to_srgb(one_pixel(view_named("ocio", 1), Rgb(0.0625f)).g), 0.5f, 1e-4);
  EXPECT_THROW(view_named("ocio:screen/Thrice"), std::runtime_error);
}

TEST_F(Ocio, ConfigurationsThatAreNotThereAreErrors) {
  setenv("OCIO", "/nowhere/config.ocio", 1);
  EXPECT_THROW(view_named("ocio"), std::runtime_error);
  unsetenv("OCIO");
  EXPECT_THROW(view_named("ocio"), std::runtime_error);
}

/// A view of data, such as Blender's "Raw", shows the numbers of the space that the configuration works in, and not those
/// of the space by which dspm enters.
TEST_F(Ocio, EntersByAcesAndShowsTheSpaceThatItWorksIn) {
  const Configuration configuration(kAcesConfiguration);
  const Rgb colour(0.5f, 0.25f, 0.125f);
  const Rgb light = one_pixel(view_named("ocio:screen/Light"), colour),
            numbers = one_pixel(view_named("ocio:Numbers"), colour);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(linear_to_srgb(light[c]), colour[c], 1e-3);
    EXPECT_NEAR(linear_to_srgb(numbers[c]), colour[c] / 2, 1e-3);
  }
}

}  // namespace view_test
}  // namespace dspm
