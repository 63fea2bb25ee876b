// Velocities of vertices in mesh files: while the shutter is open, they move.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/session/load.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/box_scene.h"
#include "tests/integrators/flat_picture.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace velocities_test {

using namespace flat_picture;

const char *const kThree = "property float vx\nproperty float vy\nproperty float vz\n",
                  *const kLong = "property double velocity_x\nproperty float velocity_y\nproperty float velocity_z\n",
                  *const kList = "property list uchar float velocity\n", *const kOpen = R"("float shutterclose" 1)";

/// A square around x; `more` follows the position of each of its vertices. Without its last vertex it is a triangle.
std::string ply(double x, const std::string& properties = "", const std::string& more = "", int vertices = 4) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n",
      vertices, properties);
  const double corners[4][2] = {{x - 0.5, -2}, {x + 0.5, -2}, {x + 0.5, 2}, {x - 0.5, 2}};
  for (int i = 0; i < vertices; ++i) text += fmt::format("{} {} 0 {}\n", corners[i][0], corners[i][1], more);
  return text + (vertices == 4 ? "4 0 1 2 3\n" : "3 0 1 2\n");
}

class Velocities : public testing::Test {
 protected:
  static std::string text_of(const std::string& shape, const std::string& camera = kOpen) {
    return flat(camera, "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\n" + shape);
  }
  Image render(const std::string& text, int iterations = 1024, const char* name = "test.dsc", int frame = 0) {
    return TestScene(text, directory / name).render(FileFrame(frame), iterations);
  }
  static void expect_crossing(const Image& image, double end, const std::string& what) {
    for (int x = 0; x < 32; ++x) {
      const double left = -4 + x * 0.25;
      const double expected = mean(left, left + 0.25, [&](double at) { return covered(at, 0, end); });
      EXPECT_NEAR(brightness(image, x), expected, 0.01) << what << ", pixel " << x;
    }
  }

  TemporaryDirectory directory;
};

// By the frame, or by the second where frames have one. Nothing else moves.
TEST_F(Velocities, MoveVertices) {
  const std::string shape = R"(Shape "plymesh" "string filename" "a.ply" )";
  for (const auto& [properties, velocity] : {std::pair(kThree, "4 0 0"), {kLong, "4 0 0"}, {kList, "3 4 0 0"}}) {
    put_file(directory / "a.ply", ply(-2, properties, velocity));
    expect_crossing(render(text_of(shape)), 1, properties);
  }
  EXPECT_EQ(render(text_of(shape, ""), 16), render(text_of(shape + R"("float velocityscale" 0)"), 16));
  expect_crossing(render(text_of(shape + R"("float velocityscale" 0.5)")), 0.5, "half of them");
  std::string by_second = text_of(shape);
  replace(by_second, "Frames 2", "Frames 2 \"float fps\" 4");
  expect_crossing(render(by_second), 0.25, "a second is four frames");
  put_file(directory / "a.ply", ply(2, kThree, "-4 0 0"));
  expect_crossing(render(text_of("Translate 0 0 1 Rotate 180 0 0 1 " + shape)), 1, "in the mesh's own space");
}

// A fluid: its vertices are others in the next file, or elsewhere.
TEST_F(Velocities, GoBeforeTheNextFile) {
  const std::string shape = R"(DynamicBegin "fluid" Shape "plymesh" "string filename" "a.%d.ply" DynamicEnd)";
  put_file(directory / "a.1.ply", ply(-2, kThree, "4 0 0"));
  put_file(directory / "a.2.ply", ply(2, kThree, "-4 0 0", 3));
  expect_crossing(render(text_of(shape)), 1, "other vertices");
  Diagnostics diagnostics;
  const LoadedScene loaded((directory / "test.dsc").string(), text_of(shape), {}, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty());
  put_file(directory / "a.2.ply", ply(-9, kThree, "-4 0 0"));
  expect_crossing(render(text_of(shape)), 1, "the same vertices");
}

TEST_F(Velocities, ShutterStaysClosedIfNothingHasAny) {
  put_file(directory / "a.ply", ply(-2));
  const std::string shape = R"(Shape "plymesh" "string filename" "a.ply" )";
  EXPECT_FALSE(TestScene(text_of(shape), directory / "test.dsc").job().shutter.delays());
  put_file(directory / "a.ply", ply(-2, kThree, "4 0 0"));
  EXPECT_TRUE(TestScene(text_of(shape), directory / "test.dsc").job().shutter.delays());
  EXPECT_FALSE(TestScene(text_of(shape + R"("float velocityscale" 0)"), directory / "test.dsc").job().shutter.delays());
}

// pbrt does not know them, and its shutter is open unless the scene says otherwise.
TEST_F(Velocities, InPbrtFilesOnlyIfTheyAreScaled) {
  put_file(directory / "a.ply", ply(-2, kThree, "2 0 0"));
  const std::string shape = R"(Shape "plymesh" "string filename" "a.ply" )";
  const auto text = [&](const std::string& scale) {
    std::string own = text_of(shape + scale, "");
    replace(own, "Frames 2\n", "");
    return own;
  };
  EXPECT_EQ(render(text(""), 16, "test.pbrt"), render(text(""), 16));
  expect_crossing(render(text(R"("float velocityscale" 2)"), 1024, "test.pbrt"), 1, "pbrt");
}

TEST_F(Velocities, FaultsAreErrors) {
  const auto error = [&](const std::string& file, const std::string& more = "") -> std::string {
    put_file(directory / "a.ply", file);
    try {
      TestScene scene(text_of("Shape \"plymesh\" \"string filename\" \"a.ply\" " + more), directory / "test.dsc");
    } catch (const SceneError& thrown) {
      return thrown.what();
    }
    return "";
  };
  EXPECT_NE(error(ply(-2, kList, "2 4 0")).find("a velocity of 2 numbers, not 3"), std::string::npos);
  EXPECT_NE(error(ply(-2, kThree, "inf 0 0")), "");
  EXPECT_NE(error(ply(-2, kThree, "4 0 0"), R"("bool velocityscale" true)"), "");
  EXPECT_NE(error(ply(-2, kThree, "4 0 0"), R"("point3 extent" [-3 -2 0 1 2 0])").find("beyond this box"),
            std::string::npos);
  EXPECT_EQ(error(ply(-2, kThree, "4 0 0"), R"("point3 extent" [-3 -2 0 3 2 0])"), "");
  EXPECT_NE(error(ply(-2, kThree, "3e38 0 0"), R"("float velocityscale" 9)").find("by its velocities, vertex 0 is not"),
            std::string::npos);
}

}  // namespace velocities_test
}  // namespace dspm::test
