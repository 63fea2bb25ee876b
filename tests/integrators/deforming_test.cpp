// Meshes of files that deform while the shutter is open: pictures known by formula, and those of sharp frames.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/session/load.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/flat_picture.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace deforming_test {

using namespace flat_picture;

using Points = std::vector<std::array<double, 2>>;

Points square_at(double x) { return {{x - 0.5, -2}, {x + 0.5, -2}, {x + 0.5, 2}, {x - 0.5, 2}}; }

/// A PLY file of a polygon, whose `more` follows the position of each vertex.
std::string ply(const Points& corners, const std::string& properties = "", const std::string& more = "") {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n",
      corners.size(), properties);
  for (const auto& [x, y] : corners) text += fmt::format("{} {} 0 {}\n", x, y, more);
  text += fmt::format("{}", corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) text += fmt::format(" {}", i);
  return text + "\n";
}

std::string obj(const Points& corners) {
  std::string text, face = "f";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    text += fmt::format("v {} {} 0\n", corners[i][0], corners[i][1]);
    face += fmt::format(" {}", i + 1);
  }
  return text + face + "\n";
}

const char *const kVelocity = "property float vx\nproperty float vy\nproperty float vz\n",
                  *const kOpen = R"("float shutterclose" 1)";

class Deforming : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) { put_file(directory / name, text); }
  static std::string glowing(const std::string& shapes) {
    return "DynamicBegin \"wall\"\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\n" + shapes +
           "\nDynamicEnd\n";
  }
  Image render(const std::string& text, int frame = 0, int iterations = 16, const char* name = "test.dsc") {
    return TestScene(text, directory / name).render(FileFrame(frame), iterations);
  }
  Image render_shape(const std::string& shape, const std::string& camera = kOpen, int frame = 0, int iterations = 16) {
    return render(flat(camera, glowing("Shape " + shape)), frame, iterations);
  }
  static void expect_crossing(const Image& image, double open, double close, const std::string& what) {
    for (int x = 0; x < 32; ++x) {
      const double left = -4 + x * 0.25;
      const double expected = mean(left, left + 0.25, [&](double at) { return covered(at, open, close); });
      EXPECT_NEAR(brightness(image, x), expected, 0.01) << what << ", pixel " << x;
    }
  }

  TemporaryDirectory directory;
};

TEST_F(Deforming, VerticesAreOnTheirWayToTheNextFile) {
  for (const int frame : {1, 2}) {
    put(fmt::format("a.{}.ply", frame), ply(square_at(frame == 1 ? -2 : 2)));
    put(fmt::format("a.{}.obj", frame), obj(square_at(frame == 1 ? -2 : 2)));
  }
  const char* const shape = R"("plymesh" "string filename" "a.%d.ply")";
  const Image image = render_shape(shape, kOpen, 0, 1024);
  expect_crossing(image, 0, 1, "to the next");
  EXPECT_EQ(render_shape(R"("objmesh" "string filename" "a.%d.obj")", kOpen, 0, 1024), image);
  EXPECT_EQ(render_shape(R"("plymesh" "string filename@1" "a.1.ply" "string filename@2" "a.2.ply")", kOpen, 0, 1024),
            image);
  expect_crossing(render_shape(shape, R"("float shutteropen" -0.5 "float shutterclose" 0)", 1, 1024), 0.5, 1,
                  "from the file before");
  EXPECT_EQ(render_shape(shape, kOpen, 1), render_shape(shape, "", 1)) << "there is no next file";
  expect_crossing(
      render_shape(R"("plymesh" "string filename@1" "a.1.ply" "string filename@3" "a.2.ply")", kOpen, 1, 1024), 0, 1,
      "both frames have one file, and only the second is followed by another");
  put("a.3.ply", ply(square_at(-2)));
  expect_crossing(render_shape(shape, kOpen, 1, 1024), 0, 1, "the next file is that of no frame");
}

// The middle of three frames is seen for three halves of a frame: the square crosses the film, and half of it again.
TEST_F(Deforming, TheWayMayLeadBeyondTheNextFile) {
  for (const int frame : {1, 2, 3}) put(fmt::format("a.{}.ply", frame), ply(square_at(frame % 2 == 1 ? -2 : 2)));
  const Image image = render_shape(R"("plymesh" "string filename" "a.%d.ply")", R"("float shutterclose" 1.5)", 0, 1024);
  for (int x = 0; x < 32; ++x) {
    const double left = -4 + x * 0.25;
    const double expected =
        mean(left, left + 0.25, [&](double at) { return (covered(at, 0, 1) + 0.5 * covered(at, 0.5, 1)) / 1.5; });
    EXPECT_NEAR(brightness(image, x), expected, 0.015) << "pixel " << x;
  }
}

// Vertices turn by a right angle. On straight ways to there, they are a square that is turned by atan(t / (1 - t)), of
// the size hypot(t, 1 - t).
TEST_F(Deforming, SquareThatIsTurnedInItsFiles) {
  put("a.1.ply", ply({{-0.8, -0.8}, {0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}}));
  put("a.2.ply", ply({{0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}, {-0.8, -0.8}}));
  const Image image = render_shape(R"("plymesh" "string filename" "a.%d.ply")", kOpen, 0, 4096);
  constexpr int kPlaces = 8, kTimes = 256;
  const auto is_covered = [](double x, double y, double t) {
    const double size2 = t * t + (1 - t) * (1 - t), u = ((1 - t) * x + t * y) / size2,
                 v = ((1 - t) * y - t * x) / size2;
    return std::max(std::abs(u), std::abs(v)) < 0.8;
  };
  for (int y = 0; y < 4; ++y)
    for (int x = 12; x < 20; ++x) {
      int count = 0;
      for (int i = 0; i < kPlaces * kPlaces * kTimes; ++i)
        count +=
            is_covered(-4 + 0.25 * (x + (i % kPlaces + 0.5) / kPlaces),
                       1 - 0.25 * (y + (i / kPlaces % kPlaces + 0.5) / kPlaces), (i / kPlaces / kPlaces + 0.5) / kTimes)
                ? 1
                : 0;
      EXPECT_NEAR(static_cast<double>(image.at(x, y).g), static_cast<double>(count) / (kPlaces * kPlaces * kTimes),
                  0.03)
          << x << ", " << y;
    }
}

TEST_F(Deforming, OtherVerticesHoldAndANoteSaysSo) {
  const Points left = square_at(-2), right = square_at(2);
  put("a.1.ply", ply(left)), put("a.2.ply", ply({right[0], right[1], right[2]})), put("a.3.ply", ply(right));
  const std::string shape = R"("plymesh" "string filename" "a.%d.ply")";
  for (const int frame : {0, 1}) EXPECT_EQ(render_shape(shape, kOpen, frame), render_shape(shape, "", frame));
  for (const std::string extent : {"", R"( "point3 extent" [-3 -2 0 3 2 0])"}) {
    Diagnostics diagnostics;
    const std::string text = flat(kOpen, glowing("Shape " + shape + extent));
    const LoadedScene loaded((directory / "test.dsc").string(), text, {}, diagnostics);
    ASSERT_EQ(diagnostics.all().size(), 1u) << "once for the sequence";
    EXPECT_EQ(diagnostics.all().front().severity, Severity::note);
    EXPECT_EQ(diagnostics.all().front().message.find("\"a.1.ply\" and \"a.2.ply\" differ in their vertices or faces"),
              0u);
    EXPECT_EQ(diagnostics.all().front().where.line, 11);
  }
  Diagnostics diagnostics;
  const LoadedScene closed((directory / "test.dsc").string(), flat("", glowing("Shape " + shape)), {}, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty());
}

TEST_F(Deforming, HoldsWhereItIsAskedTo) {
  for (const int frame : {1, 2}) put(fmt::format("a.{}.ply", frame), ply(square_at(frame == 1 ? -2 : 2)));
  const std::string shape = R"("plymesh" "string filename" "a.%d.ply" )";
  for (const int frame : {0, 1})
    EXPECT_EQ(render_shape(shape + R"("string between" "hold")", kOpen, frame), render_shape(shape, "", frame));
  EXPECT_EQ(render_shape(shape + R"("string between" "linear")"), render_shape(shape));
  try {
    render_shape(shape + R"("string between" "cubic")");
    ADD_FAILURE();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("test.dsc:11:"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("cannot be \"cubic\""), std::string::npos) << error.what();
  }
  EXPECT_THROW(render_shape(shape + R"("string between@1" "hold" "string between@2" "linear")"), SceneError);
}

// Without a shutter, the file after the last frame is not looked at.
TEST_F(Deforming, ClosedShutterReadsNoOtherFile) {
  for (const int frame : {1, 2}) put(fmt::format("a.{}.ply", frame), ply(square_at(frame == 1 ? -2 : 2)));
  const std::string shape = R"("plymesh" "string filename" "a.%d.ply")";
  const Image sharp = render_shape(shape, "", 1);
  put("a.3.ply", "bad");
  EXPECT_EQ(render_shape(shape, "", 1), sharp);
  EXPECT_THROW(render_shape(shape, kOpen, 1), SceneError);
}

// What is made of a mesh that deforms: instances, places, repaired and displaced meshes, those that are read late.
TEST_F(Deforming, WhateverIsMadeOfThem) {
  const auto file = [&](double x) { return ply(square_at(x), "property float u\nproperty float v\n", "0 0"); };
  put("a.1.ply", file(-2)), put("a.2.ply", file(2));
  const std::string mesh = R"(Shape "plymesh" "string filename" "a.%d.ply" )";
  const Image plain = render(flat(kOpen, glowing(mesh)), 0, 64);
  const auto same = [&](const std::string& contents) {
    const Image image = render(flat(kOpen, contents), 0, 64);
    double most = 0;
    for (int x = 0; x < 32; ++x) most = std::max(most, std::abs(brightness(image, x) - brightness(plain, x)));
    return most < 0.005;
  };
  EXPECT_TRUE(same(glowing(mesh + R"("point3 extent" [-3 -2 0 3 2 0])")));
  EXPECT_TRUE(same(glowing(mesh + R"("bool repair" true)")));
  EXPECT_TRUE(same(glowing("Translate 0 0 1 " + mesh)));
  EXPECT_TRUE(same(glowing("Keyframe 1 Translate 0 0 1 Keyframe 2 Translate 0 0 2 KeyframeEnd " + mesh)));
  EXPECT_TRUE(same(glowing(mesh + R"("float displacement" 0.5 "float edgelength" 0.5)")));
  EXPECT_TRUE(
      same("DynamicBegin \"o\" ObjectBegin \"wall\" AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" "
           "true " +
           mesh + "ObjectEnd ObjectInstance \"wall\" Translate 0 0 1 ObjectInstance \"wall\" DynamicEnd"));
}

TEST_F(Deforming, KeepsEveryPromise) {
  for (const int frame : {1, 2, 3}) put(fmt::format("a.{}.ply", frame), ply(square_at(frame - 2.)));
  put("v.ply", ply(square_at(1), kVelocity, "-2 0 0"));
  std::string text = flat(R"("float shutteropen" -0.25 "float shutterclose" 0.75)",
                          fmt::format(R"(
DynamicBegin "wall"
  Shape "plymesh" "string filename" "{0}"
DynamicEnd
Translate 0 0.5 -1
Shape "plymesh" "string filename" "{1}"
LightSource "infinite" "rgb L" [1 1 1]
LightSource "point" "rgb I" [9 9 9] "point3 from" [0 0 -4]
)",
                                      (directory / "a.%d.ply").string(), (directory / "v.ply").string()));
  for (const char* integrator : {"path", "dsppm\" \"integer photons\" 1000 \"string noise\" \"frozen"}) {
    std::string own = text;
    own.replace(own.find("\"path\""), 6, fmt::format("\"{}\"", integrator));
    for (const auto check : {check_threads, check_resume, check_joint, check_crop}) {
      const Verdict verdict = check(own, 3);
      EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
    }
  }
}

}  // namespace deforming_test
}  // namespace dspm::test
