// Sequences of files: frames in which they hold nothing, or are not there yet.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "dspm/scene/scene.h"
#include "dspm/session/load.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

constexpr const char* kPlyHead =
    "ply\nformat ascii 1.0\nelement vertex {0}\nproperty float x\nproperty float y\nproperty float z\n"
    "element face {1}\nproperty list uchar int vertex_indices\nend_header\n";

class Sequences : public testing::Test {
 protected:
  void put(int number, bool has_faces) {
    const std::string triangle = fmt::format("{} 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", -number);
    put_file(directory / fmt::format("a.{}.ply", number),
             fmt::format(fmt::runtime(kPlyHead), has_faces ? 3 : 0, has_faces ? 1 : 0) + (has_faces ? triangle : ""));
    put_file(directory / fmt::format("a.{}.obj", number),
             has_faces ? fmt::format("v {} 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", -number) : "# empty\n");
  }
  /// The shapes of each frame, in a scene of five.
  std::vector<int> shapes(const std::string& shape, const Choices& choices = {}) {
    const LoadedScene loaded((directory / "scene.dsc").string(),
                             "Frames 5 WorldBegin LightSource \"infinite\" DynamicBegin \"fluid\" AreaLightSource "
                             "\"diffuse\"\n" +
                                 shape + "\nDynamicEnd",
                             choices, diagnostics);
    std::vector<int> counts;
    for (const FileFrame frame : loaded.job.frames)
      counts.push_back(static_cast<int>(loaded.world->scene(std::vector{frame})->shapes.size()));
    return counts;
  }
  std::string messages() const {
    std::string text;
    for (const Diagnostic& each : diagnostics.all()) text += each.message + "\n";
    return text;
  }

  TemporaryDirectory directory;
  Diagnostics diagnostics;
};

TEST_F(Sequences, WithoutFacesThereIsNoShape) {
  for (const int frame : {1, 2, 3, 4, 5}) put(frame, frame == 2 || frame == 4);
  for (const char* shape :
       {R"(Shape "plymesh" "string filename" "a.%d.ply")", R"(Shape "objmesh" "string filename" "a.%d.obj")"}) {
    diagnostics = Diagnostics();
    EXPECT_EQ(shapes(shape), (std::vector<int>{0, 1, 0, 1, 0})) << shape;
    EXPECT_EQ(messages(), "3 of the 5 files of this sequence have no faces: the shape is not there in their frames\n");
  }
}

TEST_F(Sequences, OneFileWithoutFacesIsAnError) {
  put(1, false);
  for (const char* name : {"a.1.ply", "a.1.obj"}) {
    diagnostics = Diagnostics();
    EXPECT_THROW(shapes(fmt::format("Shape \"{}mesh\" \"string filename\" \"{}\"", name + 4, name)), SceneError);
    EXPECT_EQ(messages(), "the file has no faces\n");
    EXPECT_EQ(diagnostics.all().front().where.line, 2);
  }
}

// A cache that is still being written: the first three frames can be rendered.
TEST_F(Sequences, OfFramesThatAreNotRenderedFilesMayBeMissing) {
  for (const int frame : {1, 2, 3}) put(frame, true);
  const char* const shape = R"(Shape "plymesh" "string filename" "a.%d.ply")";
  Choices choices;
  choices.frames = {Moment(0), Moment(1), Moment(2)};
  EXPECT_EQ(shapes(shape, choices), (std::vector<int>{1, 1, 1}));
  EXPECT_EQ(messages(),
            "2 of 5 files are missing, the first of them \"a.4.ply\": their frames are not rendered, and "
            "nothing was looked at there\n");
  diagnostics = Diagnostics();
  EXPECT_THROW(shapes(shape), SceneError);
  diagnostics = Diagnostics();
  choices.frames = {Moment(3)};
  EXPECT_THROW(shapes(shape, choices), SceneError);
}

}  // namespace
}  // namespace dspm::test
