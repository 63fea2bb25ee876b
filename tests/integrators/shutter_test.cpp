// What moves while the shutter is open: images known by formula, and the mean of many sharp images.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/session/job/choices.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/box_scene.h"
#include "tests/integrators/flat_picture.h"
#include "tests/support/seeds.h"

namespace dspm::test {
namespace shutter_test {

using namespace flat_picture;

const char* const kSquare = R"(
DynamicBegin "square"
  Keyframe 1
    Translate -2 0 0
  Keyframe 2
    Translate 2 0 0
  KeyframeEnd
  AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
  Shape "bilinearmesh" "point3 P" [-.5 -2 0 .5 -2 0 -.5 2 0 .5 2 0]
DynamicEnd
)";

struct Times {
  const char* camera;
  double open, close;
};

TEST(Shutter, SquareThatCrossesTheFilm) {
  for (const Times& times : {Times{R"("float shutterclose" 1)", 0, 1}, Times{R"("float shutterclose" 0.5)", 0, 0.5},
                             Times{R"("float shutteropen" 0.25 "float shutterclose" 0.5)", 0.25, 0.5}}) {
    const Image image = TestScene(flat(times.camera, kSquare)).render(FileFrame(0), 1024);
    for (int x = 0; x < 32; ++x) {
      const double left = -4 + x * 0.25;
      const double expected = mean(left, left + 0.25, [&](double at) { return covered(at, times.open, times.close); });
      EXPECT_NEAR(brightness(image, x), expected, 0.01) << times.camera << ", pixel " << x;
    }
  }
}

// A Gaussian of alpha 2 within 1.5 pixels, less its value there.
TEST(Shutter, SquareThatCrossesAGaussianFilter) {
  const Image image = TestScene(flat(R"("float shutterclose" 1)", kSquare, R"("gaussian")")).render(FileFrame(0), 1024);
  for (int x = 2; x < 30; ++x) {
    const double center = -4 + (x + 0.5) * 0.25, radius = 1.5 * 0.25;
    double weights = 0, sum = 0;
    mean(center - radius, center + radius, [&](double at) {
      const double d = (at - center) / 0.25,
                   weight = std::exp(-d * d / (2 * 0.5 * 0.5)) - std::exp(-1.5 * 1.5 / (2 * 0.5 * 0.5));
      weights += weight, sum += weight * covered(at, 0, 1);
      return 0;
    });
    EXPECT_NEAR(brightness(image, x), sum / weights, 0.01) << "pixel " << x;
  }
}

TEST(Shutter, FrameAfterTheLastKeyStandsStill) {
  const Image expected = TestScene(flat("", kSquare)).render(FileFrame(1), 16);
  EXPECT_EQ(TestScene(flat(R"("float shutterclose" 1)", kSquare)).render(FileFrame(1), 16), expected);
}

TEST(Shutter, WheelOfManyTurnsIsADisk) {
  const char* const wheel = R"(
DynamicBegin "wheel"
  Keyframe 1
    Rotate 0 0 0 1
  Keyframe 2
    Rotate 7290 0 0 1
  KeyframeEnd
  AreaLightSource "diffuse" "rgb L" [1 0 0] "bool twosided" true
  Shape "disk" "float radius" 0.9 "float phimax" 180
  Rotate 180 0 0 1
  AreaLightSource "diffuse" "rgb L" [0 1 0] "bool twosided" true
  Shape "disk" "float radius" 0.9 "float phimax" 180
DynamicEnd
)";
  const Image image = TestScene(flat(R"("float shutterclose" 1)", wheel)).render(FileFrame(0), 1024);
  for (const int x : {14, 15, 16, 17})
    for (const int y : {3, 4}) {
      // 20.25 turns: each place has either colour for half of the time, but for a quarter of a turn.
      EXPECT_NEAR(static_cast<double>(image.at(x, y).r), 0.5, 0.03) << x << ", " << y;
      EXPECT_NEAR(static_cast<double>(image.at(x, y).r + image.at(x, y).g), 1, 0.01) << x << ", " << y;
    }
}

// pbrt's language: a camera or a thing that is elsewhere at the end of the shutter, and times of its own.
TEST(Shutter, TransformsOfPbrtThatDifferBetweenTwoTimes) {
  const auto scene = [](const std::string& camera, const std::string& before, const std::string& place) {
    return fmt::format(R"(
{}
Integrator "path"
PixelFilter "box"
Film "rgb" "integer xresolution" 32 "integer yresolution" 8
LookAt 0 0 -5  0 0 0  0 1 0
{}
Camera "orthographic" "float screenwindow" [-4 4 -1 1]
WorldBegin
{}
AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
Shape "bilinearmesh" "point3 P" [-.5 -2 0 .5 -2 0 -.5 2 0 .5 2 0]
)",
                       before, camera, place);
  };
  const auto expect_crossing = [](const std::string& text, double from, double speed) {
    const Image image = TestScene(text, "test.pbrt").render(FileFrame(0), 1024);
    for (int x = 0; x < 32; ++x) {
      const double left = -4 + x * 0.25;
      const double expected = mean(left, left + 0.25, [&](double at) {
        const double a = (at - 0.5 - from) / speed, b = (at + 0.5 - from) / speed;
        return std::max(0., std::min(1., std::max(a, b)) - std::max(0., std::min(a, b)));
      });
      EXPECT_NEAR(brightness(image, x), expected, 0.01) << text << ", pixel " << x;
    }
  };
  const std::string goes =
      "ActiveTransform StartTime Translate -2 0 0 ActiveTransform EndTime Translate 2 0 0 "
      "ActiveTransform All";
  expect_crossing(scene("", "", goes), -2, 4);
  expect_crossing(scene("", "TransformTimes 0 2", goes), -2, 2);
  // The camera looks along z from -5; it goes to the right, and with it the screen.
  expect_crossing(scene("ActiveTransform EndTime Translate -2 0 0 ActiveTransform All", "", ""), 0, -2);
  expect_crossing(scene("", "",
                        "ObjectBegin \"o\" ObjectEnd AttributeBegin " + goes +
                            " CoordinateSystem \"there\" AttributeEnd CoordSysTransform \"there\""),
                  -2, 4);
}

TEST(Shutter, LampThatFades) {
  const char* const lamp = R"(
AreaLightSource "diffuse" "rgb L@1" [0 0 0] "rgb L@2" [2 4 0] "bool twosided" true
Shape "bilinearmesh" "point3 P" [-9 -9 0 9 -9 0 -9 9 0 9 9 0]
)";
  const Image image = TestScene(flat(R"("float shutterclose" 0.5)", lamp)).render(FileFrame(0), 256);
  for (const int x : {0, 15, 31}) {
    EXPECT_NEAR(static_cast<double>(image.at(x, 4).r), 0.5, 0.005);
    EXPECT_NEAR(brightness(image, x), 1, 0.01);
  }
}

TEST(Shutter, ClosedIfNothingMovesOrNothingIsAskedFor) {
  const char* const still = R"(
AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
Shape "bilinearmesh" "point3 P" [-.5 -2 0 .5 -2 0 -.5 2 0 .5 2 0]
)";
  EXPECT_EQ(TestScene(flat(R"("float shutterclose" 1)", still)).render(FileFrame(0), 8),
            TestScene(flat("", still)).render(FileFrame(0), 8));
  Choices no_blur, half;
  no_blur.shutter = 0, half.shutter = 0.5;
  EXPECT_EQ(TestScene(flat(R"("float shutterclose" 1)", kSquare), no_blur).render(FileFrame(0), 8),
            TestScene(flat("", kSquare)).render(FileFrame(0), 8));
  EXPECT_EQ(TestScene(flat("", kSquare), half).render(FileFrame(0), 8),
            TestScene(flat(R"("float shutterclose" 0.5)", kSquare)).render(FileFrame(0), 8));
}

TEST(Shutter, ThatCannotBeIsAnError) {
  const auto error = [](const std::string& camera) -> std::string {
    try {
      TestScene scene(flat(camera, kSquare));
    } catch (const SceneError& thrown) {
      return thrown.what();
    }
    return "";
  };
  EXPECT_NE(error(R"("float shutteropen" 1 "float shutterclose" 0.5)")
                .find("the shutter closes at 0.5, before it opens at 1"),
            std::string::npos);
  EXPECT_NE(error(R"("float shutterclose" 1e9)").find("must lie between -1000 and 1000"), std::string::npos);
  EXPECT_NE(error(R"("float shutterclose@1" 1 "float shutterclose@2" 0.5)").find("must be the same in all frames"),
            std::string::npos);
}

/// A ball, its material, a lamp and the camera move from time 0 to 1, which are `moments`.
std::string moving_box(const std::string& integrator, const std::string& moments, const std::string& begin,
                       const std::string& end, const std::string& camera) {
  std::string text = box(fmt::format("Frames {}\nIntegrator {} \"integer maxdepth\" 5\n", moments, integrator),
                         fmt::format(R"(
MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance@{0}" [.9 .1 .1] "rgb reflectance@{1}" [.1 .1 .9]
LightSource "spot" "rgb I@{0}" [1 1 1] "rgb I@{1}" [9 6 3] "point3 from" [0.6 0.7 -0.6] "point3 to" [0 -1 0]
  "float coneangle" 30
DynamicBegin "balls"
  Keyframe {0}
    Translate -0.5 -0.6 0.2
  Keyframe {1}
    Translate 0.4 -0.2 0.1
  KeyframeEnd
  AttributeBegin
    Material "dielectric"
    Shape "sphere" "float radius" 0.35
  AttributeEnd
  Translate 0 0.7 0
  NamedMaterial "paint"
  Shape "sphere" "float radius" 0.2
DynamicEnd
)",
                                     begin, end),
                         24);
  replace(text, "LookAt", fmt::format("Keyframe {}\nLookAt", begin));
  replace(text, "Camera \"perspective\"",
          fmt::format("Keyframe {}\nLookAt 0.4 0.2 -3.2  0 0 0  0 1 0\nKeyframeEnd\nCamera \"perspective\" {}", end,
                      camera));
  return text;
}

struct Way {
  const char* integrator;
  int iterations;
  double bias;
};
class EveryIntegrator : public testing::TestWithParam<Way> {};

// 32 sharp frames at the middles of 32 parts of the shutter, after one that does not count.
TEST_P(EveryIntegrator, GivesTheMeanOfSharpImages) {
  const Way& way = GetParam();
  const int times = seeds(5);
  TestScene sharp(moving_box(way.integrator, "33", "1.5", "33.5", ""));
  std::vector<std::vector<Image>> means;
  for (int seed = 1; seed <= times; ++seed) {
    sharp.set_seed(static_cast<std::uint64_t>(seed));
    std::vector<Image> frames = sharp.render_all(way.iterations);
    frames.erase(frames.begin());
    Image mean = frames.front();
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
      mean.pixels[i] = {};
      for (const Image& frame : frames) mean.pixels[i] += frame.pixels[i] / static_cast<float>(frames.size());
    }
    means.push_back({mean});
  }
  const Tiles blurred =
      rendered(moving_box(way.integrator, "1", "1", "2", R"("float shutterclose" 1)"), 32 * way.iterations, times, 2);
  const Verdict verdict = agreement(blurred, tiles_of(means, 2), {0.01 / 5, way.bias});
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

// sppm's and dsppm's radius shrinks with iterations, of which the two have different numbers.
INSTANTIATE_TEST_SUITE_P(Scenes, EveryIntegrator,
                         testing::Values(Way{R"("path")", 4, 0.003},
                                         Way{R"("vcm" "integer photons" 1000 "float radius" 0.02)", 2, 0.01},
                                         Way{R"("dsppm" "integer photons" 3000 "float radius" 0.02)", 4, 0.01},
                                         Way{R"("sppm" "integer photons" 3000 "float radius" 0.02)", 4, 0.01},
                                         Way{R"("photonmap" "integer photons" 20000 "integer causticphotons" 20000
                                                 "float radius" 0.05 "float causticradius" 0.03 "integer nearest" 30)",
                                             2, 0.03}),
                         [](const auto& way) {
                           const std::string name = way.param.integrator;
                           return name.substr(1, name.find('"', 1) - 1);
                         });

/// A square half a pixel wide that crosses all of the film: 64 times its width.
std::string fast_square(const std::string& integrator) {
  std::string text = flat(R"("float shutterclose" 1)", R"(
DynamicBegin "square"
  Keyframe 1 Translate -4 0 0
  Keyframe 2 Translate 4 0 0
  KeyframeEnd
  AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
  Shape "bilinearmesh" "point3 P" [-.0625 -2 0 .0625 -2 0 -.0625 2 0 .0625 2 0]
DynamicEnd
)");
  replace(text, "\"path\"", integrator);
  replace(text, "\"integer yresolution\" 8", "\"integer yresolution\" 64");
  return text;
}

// Sixteen iterations of one moment each would leave sixteen copies, and between them half of the columns would have seen none.
TEST(Shutter, FastThingsLeaveAStreakInsteadOfCopies) {
  for (const char* integrator : {R"("path")", R"("dsppm" "integer photons" 100)", R"("sppm" "integer photons" 100)"}) {
    TestScene test(fast_square(integrator));
    const Image first = test.render(FileFrame(0), 16), last = test.render(FileFrame(0), 512);
    int dark = 0;
    for (int x = 1; x < 31; ++x) {
      dark += brightness(first, x) == 0;
      EXPECT_NEAR(brightness(last, x), 1. / 64, 0.1 / 64) << integrator << ", column " << x;
    }
    EXPECT_LE(dark, 3) << integrator;
  }
}

// A floor that photons light, under a wire that crosses it: each moment's part of the photons brings all of the light.
TEST(Shutter, FastThingsTakeNoLightOfPhotons) {
  const std::string floor = R"(AttributeBegin Material "diffuse" Translate 0 0 1
  Shape "bilinearmesh" "point3 P" [-9 -9 0 9 -9 0 -9 9 0 9 9 0] AttributeEnd
LightSource "distant" "rgb L" [2 2 2] "point3 from" [0 0 -1] "point3 to" [0 0 0]
)";
  std::string text =
      fast_square(R"("dsppm" "integer photons" 4001 "float radius" .5 "string direct" "photons")") + floor;
  const Image image = TestScene(text).render(FileFrame(0), 64);
  double sum = 0;
  for (int x = 0; x < 32; ++x) sum += brightness(image, x) / 32;
  EXPECT_NEAR(sum / (2 * 0.5 / 3.14159265), 1, 0.08);
}

TEST(Shutter, FastThingsKeepEveryPromise) {
  for (const char* integrator : {R"("path")", R"("dsppm" "integer photons" 100)"})
    for (const auto check : {check_threads, check_resume, check_joint, check_crop}) {
      const Verdict verdict = check(fast_square(integrator), 3);
      EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
    }
}

TEST(Shutter, KeepsEveryPromise) {
  for (const char* integrator :
       {R"("path")", R"("vcm" "integer photons" 500)", R"("dsppm" "integer photons" 1000)",
        R"("sppm" "integer photons" 1000)", R"("photonmap" "integer photons" 1000 "integer causticphotons" 1000)"}) {
    const std::string text = moving_box(integrator, "3", "1", "4", R"("float shutterclose" 0.75)");
    for (const auto check : {check_threads, check_resume, check_joint, check_crop}) {
      const Verdict verdict = check(text, 3);
      EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
    }
  }
}

}  // namespace shutter_test
}  // namespace dspm::test
