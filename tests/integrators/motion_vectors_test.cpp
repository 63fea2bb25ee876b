// Vectors of the motion of things, forward and backward, against what formulas say.
#include "tests/integrators/motion_vectors.h"

#include <cmath>
#include <fstream>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace motion_vectors_test {

using namespace motion_vectors;

/// A picture of 4 pixels a unit, -4 <= x <= 4 and -2 <= y <= 2.
std::string flat(const std::string& contents, const std::string& frames = "3", const std::string& camera = "") {
  return fmt::format(R"(
Frames {}
Option "disablepixeljitter" true
Integrator "path"
PixelFilter "box"
Film "rgb" "integer xresolution" 32 "integer yresolution" 16
LookAt 0 0 -5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-4 4 -2 2] {}
WorldBegin
LightSource "infinite"
{}
)",
                     frames, camera, contents);
}

const char* const kSquare = R"(
DynamicBegin "square"
  Keyframe 1 Translate -2 0 0 Keyframe 2 Translate 1 .5 0 Keyframe 3 Translate 1 -.25 0 KeyframeEnd
  Shape "bilinearmesh" "point3 P" [-1 -1 0 1 -1 0 -1 1 0 1 1 0]
DynamicEnd
)";

// 4 pixels a unit. Before the first key and after the last, it stands still.
TEST(MotionVectors, OfASquareThatMovesByKnownPixels) {
  const Vectors vectors = vectors_of(flat(kSquare));
  expect(vectors, "forward", 0, 8, 8, {12, 2});
  expect(vectors, "backward", 0, 8, 8, {0, 0});
  expect(vectors, "forward", 1, 20, 6, {0, -3});
  expect(vectors, "backward", 1, 20, 6, {-12, -2});
  expect(vectors, "forward", 2, 20, 9, {0, 0});
  expect(vectors, "backward", 2, 20, 9, {0, 3});
  for (const int frame : {0, 1, 2}) expect(vectors, "forward", frame, 30, 8, {0, 0});  // the sky
}

TEST(MotionVectors, GoBeyondTheFramesOfTheFileIfThereAreKeys) {
  const Vectors vectors = vectors_of(flat(kSquare, "1"));
  expect(vectors, "forward", 0, 8, 8, {12, 2});
  expect(vectors, "backward", 0, 8, 8, {0, 0});
}

TEST(MotionVectors, OfAWheelTurnAboutItsAxis) {
  const Vectors vectors = vectors_of(flat(R"(
DynamicBegin "wheel"
  Keyframe 1 Rotate 0 0 0 1 Keyframe 3 Rotate 60 0 0 1 KeyframeEnd
  Shape "disk" "float radius" 1.9
DynamicEnd
)"));
  const double angle = 30 * std::acos(-1.) / 180, c = std::cos(angle), s = std::sin(angle);
  for (const int x : {12, 16, 20})
    for (const int y : {4, 8, 11}) {
      const double a = right(x), b = up(y);
      expect(vectors, "forward", 0, x, y, {a * c - b * s - a, a * s + b * c - b});
      expect(vectors, "forward", 1, x, y, {a * c - b * s - a, a * s + b * c - b});
      expect(vectors, "backward", 1, x, y, {a * c + b * s - a, -a * s + b * c - b});
    }
}

// An object within an object: 2 units to the right, and a growth to twice the size about (1, 0), its middle then.
TEST(MotionVectors, OfAnInstance) {
  const Vectors vectors = vectors_of(flat(R"(
ObjectBegin "plate" Shape "disk" "float radius" .9 ObjectEnd
DynamicBegin "plates"
  Keyframe 1 Translate -1 0 0 Scale 1 1 1 Keyframe 2 Translate 1 0 0 Scale 2 2 1 KeyframeEnd
  ObjectInstance "plate"
DynamicEnd
)"));
  for (const int x : {10, 12, 14})
    for (const int y : {6, 8}) expect(vectors, "forward", 0, x, y, {8 + right(x) + 4, up(y)});
}

TEST(MotionVectors, BehindGlassAreThoseOfTheGlass) {
  const Vectors vectors = vectors_of(flat(R"(
DynamicBegin "pane"
  Keyframe 1 Translate 0 0 -1 Keyframe 2 Translate 1 0 -1 KeyframeEnd
  Material "thindielectric"
  Shape "disk" "float radius" 3
DynamicEnd
)" + std::string(kSquare)));
  expect(vectors, "forward", 0, 8, 8, {4, 0});
}

TEST(MotionVectors, OfAShapeWhoseParametersHaveKeys) {
  const Vectors vectors = vectors_of(flat(R"(
DynamicBegin "ball"
  Shape "sphere" "float radius@1" 1 "float radius@2" 1.5
DynamicEnd
)"));
  for (const int x : {14, 17}) {
    expect(vectors, "forward", 0, x, 8, {right(x) * 0.5, up(8) * 0.5}, 0.01);
    expect(vectors, "backward", 1, x, 8, {right(x) * (1 / 1.5 - 1), up(8) * (1 / 1.5 - 1)}, 0.01);
  }
}

/// Writes wall.1.ply .. wall.n.ply, with vertices and faces as given.
void write_walls(const TemporaryDirectory& directory, const std::vector<std::string>& vertices,
                 const std::vector<std::string>& faces) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    std::ofstream(directory / fmt::format("wall.{}.ply", i + 1))
        << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
        << vertices[i] << faces[i];
}

const char* const kFaces = "3 0 1 2\n3 2 1 3\n";

constexpr const char* kWalls = R"(
DynamicBegin "wall"
  Keyframe 1 Translate 0 0 0 Keyframe 2 Translate 0 1 0 KeyframeEnd
  Shape "plymesh" "string filename" "wall.%d.ply" {}
DynamicEnd
)";

// The mesh goes 1 to the right and is sheared by a quarter of its height; its block goes up.
TEST(MotionVectors, OfAMeshThatIsDeformedFollowItsTriangles) {
  for (const char* extent : {"", R"("point3 extent" [-99 -99 -1 99 99 1])"}) {
    const TemporaryDirectory directory;
    write_walls(directory, {"-8 -8 0\n8 -8 0\n-8 8 0\n8 8 0\n", "-9 -8 0\n7 -8 0\n-5 8 0\n11 8 0\n"}, {kFaces, kFaces});
    const std::string text = flat(fmt::format(kWalls, extent), "2");
    const Vectors vectors = vectors_of(text, directory / "test.dsc");
    for (const int x : {4, 20})
      for (const int y : {3, 12}) {
        expect(vectors, "forward", 0, x, y, {4 + up(y) / 4, 4});
        // The second frame shows the place that was 1 lower before.
        expect(vectors, "backward", 1, x, y, {-4 - (up(y) - 4) / 4, -4});
      }
    TestScene alone(text, asking(), directory / "test.dsc");
    EXPECT_EQ(vectors_of(alone, {FileFrame(1)}).at("motion.backward")[0], vectors.at("motion.backward")[1]);
  }
}

// A tenth of a unit a frame, of which only one is rendered: its neighbours are read, too.
TEST(MotionVectors, OfAFrameThatIsRenderedAlone) {
  constexpr int kFrames = 100;
  const TemporaryDirectory directory;
  std::vector<std::string> vertices;
  for (int i = 0; i < kFrames; ++i)
    vertices.push_back(fmt::format("{0} -8 0\n{1} -8 0\n{0} 8 0\n{1} 8 0\n", -20 + i * 0.1, 20 + i * 0.1));
  write_walls(directory, vertices, std::vector<std::string>(kFrames, kFaces));
  const std::string text = flat(R"(
DynamicBegin "wall"
  Shape "plymesh" "string filename" "wall.%d.ply" "point3 extent" [-99 -99 -1 99 99 1]
DynamicEnd
)",
                                std::to_string(kFrames));
  for (const int frame : {41, 42, 43, 44, 45, 46}) {
    Choices choices = asking();
    choices.frames = {Moment::numbered(frame)};
    TestScene test(text, choices, directory / "test.dsc");
    const Vectors vectors = vectors_of(test, {FileFrame(frame - 1)});
    expect(vectors, "forward", 0, 16, 8, {0.4, 0});
    expect(vectors, "backward", 0, 16, 8, {-0.4, 0});
  }
}

TEST(MotionVectors, OfAMeshWithOtherTrianglesFollowItsBlock) {
  const TemporaryDirectory directory;
  write_walls(directory, {"-8 -8 0\n8 -8 0\n-8 8 0\n8 8 0\n", "-9 -8 0\n7 -8 0\n-5 8 0\n11 8 0\n"},
              {kFaces, "3 0 1 3\n3 0 3 2\n"});
  const Vectors vectors = vectors_of(flat(fmt::format(kWalls, ""), "2"), directory / "test.dsc");
  expect(vectors, "forward", 0, 20, 3, {0, 4});
}

TEST(MotionVectors, AreZeroAmongVariations) {
  const Vectors vectors = vectors_of(flat(R"(
DynamicBegin "a" Translate -1 0 0 Shape "disk" DynamicEnd
DynamicBegin "b" Translate 1 0 0 Shape "disk" DynamicEnd
VariationBegin "left" Hide "b" VariationEnd
VariationBegin "right" Hide "a" VariationEnd
)",
                                          "1"));
  ASSERT_EQ(vectors.at("motion.forward").size(), 2u);
  for (const int frame : {0, 1})
    for (const int x : {12, 20}) expect(vectors, "forward", frame, x, 8, {0, 0});
}

// What stays is listed first while the shutter is open, wherever the file has it.
TEST(MotionVectors, OfWhatMovesBesideWhatStaysWhileTheShutterIsOpen) {
  const std::string wall = R"(
AttributeBegin Translate 0 0 2 Shape "bilinearmesh" "point3 P" [-9 -9 0 9 -9 0 -9 9 0 9 9 0] AttributeEnd
)";
  const char* const other = R"(
DynamicBegin "other"
  Keyframe 1 Translate 2 -1 0 Keyframe 2 Translate 2.5 -1 0 Keyframe 3 Translate 3 -1 0 KeyframeEnd
  Shape "disk" "float radius" 0.9
DynamicEnd
)";
  const Vectors vectors = vectors_of(flat(kSquare + wall + other, "2", R"("float shutterclose" 0.01)"));
  expect(vectors, "forward", 0, 24, 12, {2, 0});
  expect(vectors, "forward", 0, 16, 2, {0, 0});
}

// 6 pixels a frame at any time of the shutter.
TEST(MotionVectors, GoFromTheTimeThatIsShownToThatOfTheNextFrame) {
  const Vectors vectors = vectors_of(flat(R"(
DynamicBegin "square"
  Keyframe 1 Translate -2 0 0 Keyframe 3 Translate 1 0 0 KeyframeEnd
  Shape "bilinearmesh" "point3 P" [-1 -1 0 1 -1 0 -1 1 0 1 1 0]
DynamicEnd
)",
                                          "3", R"("float shutterclose" 0.5)"),
                                     "test.dsc", 16);
  for (const int x : {6, 8, 10, 14}) expect(vectors, "forward", 0, x, 8, {6, 0});
  expect(vectors, "backward", 1, 14, 8, {-6, 0});
}

TEST(MotionVectors, ThatDoNotExistAreRefused) {
  try {
    TestScene test(flat(kSquare), asking({"motion.sideways"}));
    test.integrator(*test.scene({FileFrame(0)}));
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("motion"), std::string::npos) << error.what();
  }
  TestScene one(flat(kSquare), asking({"motion.backward"}));
  EXPECT_EQ(one.job().settings.outputs, std::vector<std::string>{"motion.backward"});
}

}  // namespace motion_vectors_test
}  // namespace dspm::test
