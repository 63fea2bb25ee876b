// Sequences of files: frames in which they hold nothing, or are not there yet.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "dspm/base/math/moments.h"
#include "dspm/session/load.h"
#include "dspm/world/scene/scene.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace sequences_test {

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

/// The digest of what sampling derives, and the hits of rays in the frame, if it is rendered with these.
class Extents : public Sequences {
 protected:
  std::string sampling(const std::vector<Moment>& frames, const std::string& parameters, const char* around = "{}") {
    Choices choices;
    choices.frames = frames;
    const std::string shape = fmt::format(R"(Shape "plymesh" "string filename" "a.%d.ply" {})", parameters);
    const LoadedScene loaded((directory / "scene.dsc").string(),
                             "Frames 40 WorldBegin LightSource \"infinite\" DynamicBegin \"fluid\" Translate 0 1 0 " +
                                 fmt::format(fmt::runtime(around), shape) + " DynamicEnd",
                             choices, diagnostics);
    read.clear();
    for (const FileFrame frame : loaded.job.frames) {
      const auto scene = loaded.world->scene(std::vector{frame});
      read.push_back(scene->shapes.front().bounds(0));
    }
    return loaded.world->sampling();
  }

  std::vector<Bounds3> read;  // of the first triangle in each frame
};

TEST_F(Extents, FilesOfFramesThatAreNotRenderedAreNotRead) {
  for (int frame = 1; frame <= 40; ++frame) put(frame, true);
  const char* const extent = R"("point3 extent" [-50 0 0  2 1 0])";
  const std::string all = sampling({}, extent);
  const Bounds3 third = read[2];
  EXPECT_EQ(third.low, (Vec3{-3, 1, 0}));
  // Others that are read are the first, and those that learning looks at.
  int noticed = 0;
  for (int frame = 1; frame <= 40; ++frame) {
    if (frame == 3) continue;
    put_file(directory / fmt::format("a.{}.ply", frame), "bad");
    diagnostics = Diagnostics();
    try {
      sampling({Moment(2)}, extent);
    } catch (const SceneError&) {
      ++noticed;
    }
    put(frame, true);
  }
  EXPECT_LE(noticed, 17);
  diagnostics = Diagnostics();
  EXPECT_EQ(sampling({Moment(2)}, extent), all);
  EXPECT_EQ(read.front().low, third.low);
  EXPECT_EQ(read.front().high, third.high);
  EXPECT_NE(sampling({Moment(2)}, ""), all) << "the box is what counts, not the meshes";
}

TEST_F(Extents, AreTakenAtTheirWordOnlyWhereMeshesLieWithin) {
  for (int frame = 1; frame <= 40; ++frame) put(frame, true);
  EXPECT_THROW(sampling({Moment(39)}, R"("point3 extent" [-39 0 0  2 1 0])"), SceneError);
  EXPECT_NE(messages().find("a.40.ply goes beyond this box"), std::string::npos) << messages();
  diagnostics = Diagnostics();
  EXPECT_THROW(sampling({Moment(1)}, R"("point3 extent" [0 0 0])"), SceneError);
  EXPECT_EQ(messages(), "two corners of a box are expected, not 1\n");
}

// Its power in all frames decides how often a light is chosen.
TEST_F(Extents, OfLightsAllFilesAreRead) {
  for (int frame = 1; frame <= 40; ++frame) put(frame, true);
  const char *const extent = R"("point3 extent" [-50 0 0  2 1 0])", *const light = "AreaLightSource \"diffuse\" {}";
  EXPECT_EQ(sampling({Moment(2)}, extent, light), sampling({Moment(2)}, "", light));
}

}  // namespace sequences_test
}  // namespace dspm::test
