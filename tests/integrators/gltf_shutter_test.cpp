// glTF while the shutter is open: what its animation moves is where it is at each time, not only in frames.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/lang/parse.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"
#include "tests/gltf/gltf_file.h"
#include "tests/integrators/flat_picture.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace gltf_shutter_test {

using namespace flat_picture;

/// A picture of -2 <= x, y <= 2 of the file in `frames` frames, `fps` of them a second.
std::string scene_of(const std::string& file, int frames, int fps, const std::string& camera) {
  return fmt::format(R"(
Frames {} "float fps" {}
Integrator "path"
PixelFilter "box"
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
LookAt 0 0 -5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-2 2 -2 2] {}
WorldBegin
Import "{}"
)",
                     frames, fps, camera, file);
}

/// A file whose square glows and is moved by the channels of an animation of two seconds.
std::string glowing(GltfFile& file, const Square& square, const std::string& nodes, const std::string& channels,
                    const std::string& samplers, const std::string& more = "", const std::string& of_primitive = "") {
  return file.text(fmt::format(
      R"("scenes":[{{"nodes":[0]}}],"nodes":[{}],"meshes":[{{"primitives":[{}]}}],"materials":[{{"emissiveFactor":)"
      R"([1,1,1],"extensions":{{"KHR_materials_unlit":{{}}}}}}],"animations":[{{"channels":[{}],"samplers":[{}]}}]{})",
      nodes, square.primitive(",\"material\":0" + of_primitive), channels, samplers, more));
}

/// Turns about z, by quarters of a turn: once in a second.
std::vector<float> turns() {
  std::vector<float> quaternions;
  for (int quarter = 0; quarter <= 8; ++quarter) {
    const double half = quarter * std::acos(-1.0) / 4;
    for (const double c : {0., 0., std::sin(half), std::cos(half)}) quaternions.push_back(static_cast<float>(c));
  }
  return quaternions;
}
const std::vector<float> kQuarters{0, 0.25f, 0.5f, 0.75f, 1, 1.25f, 1.5f, 1.75f, 2};

/// A wheel's spoke, of which only a part is to the right of the axis.
std::string turning_node() {
  GltfFile file;
  const Square square(file);
  const int times = file.add_floats(kQuarters, "SCALAR", 1), values = file.add_floats(turns(), "VEC4", 4);
  return glowing(file, square, R"({"children":[1]},{"mesh":0,"scale":[0.6,0.3,1],"translation":[0.7,0.1,0]})",
                 R"({"sampler":0,"target":{"node":0,"path":"rotation"}})",
                 fmt::format(R"({{"input":{},"output":{}}})", times, values));
}

/// The same square on a joint, which turns.
std::string skinned() {
  GltfFile file;
  const Square square(file);
  const int joints = file.add(std::vector<std::uint8_t>(16, 0), "VEC4", 5121, 4);
  const int weights = file.add_floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  const int inverse = file.add_floats({0.6f, 0, 0, 0, 0, 0.3f, 0, 0, 0, 0, 1, 0, 0.7f, 0.1f, 0, 1}, "MAT4", 16);
  const int times = file.add_floats(kQuarters, "SCALAR", 1), values = file.add_floats(turns(), "VEC4", 4);
  std::string text = glowing(file, square, R"({"mesh":0,"skin":0},{"name":"joint"})",
                             R"({"sampler":0,"target":{"node":1,"path":"rotation"}})",
                             fmt::format(R"({{"input":{},"output":{}}})", times, values),
                             fmt::format(R"(,"skins":[{{"joints":[1],"inverseBindMatrices":{}}}])", inverse));
  const std::string attributes = fmt::format("\"TEXCOORD_0\":{}", square.uvs);
  text.replace(text.find(attributes), attributes.size(),
               fmt::format("{},\"JOINTS_0\":{},\"WEIGHTS_0\":{}", attributes, joints, weights));
  const std::string roots = "\"nodes\":[0]";
  return text.replace(text.find(roots), roots.size(), "\"nodes\":[0,1]");
}

/// The right side of the square goes to the left and back, on a curve.
std::string morphed() {
  GltfFile file;
  const Square square(file);
  const int target = file.add_floats({0, 0, 0, -1.5f, 0, 0, -1.5f, 0, 0, 0, 0, 0}, "VEC3", 3);
  const int times = file.add_floats({0, 0.5f, 2}, "SCALAR", 1),
            values = file.add_floats({0, 0, 3, 0, 1, 0, -2, 0, 0}, "SCALAR", 1);
  return glowing(file, square, R"({"mesh":0,"weights":[0]})", R"({"sampler":0,"target":{"node":0,"path":"weights"}})",
                 fmt::format(R"({{"input":{},"output":{},"interpolation":"CUBICSPLINE"}})", times, values), "",
                 fmt::format(R"(,"targets":[{{"POSITION":{}}}])", target));
}

/// Steps to the right after a third of a second.
std::string stepping() {
  GltfFile file;
  const Square square(file);
  const int times = file.add_floats({0, 1 / 3.f, 2}, "SCALAR", 1),
            values = file.add_floats({-0.5f, 0, 0, 0.75f, 0, 0, 0.75f, 0, 0}, "VEC3", 3);
  return glowing(file, square, R"({"mesh":0,"scale":[0.5,0.75,1]})",
                 R"({"sampler":0,"target":{"node":0,"path":"translation"}})",
                 fmt::format(R"({{"input":{},"output":{},"interpolation":"STEP"}})", times, values));
}

class GltfShutter : public testing::Test {
 protected:
  Image render(const std::string& text, int frame, int iterations) {
    return TestScene(text, directory / "test.dsc").render(FileFrame(frame), iterations);
  }
  TemporaryDirectory directory;
};

// The first second, and the second in which the animation goes on after the last frame: the mean of 64 sharp frames.
TEST_F(GltfShutter, ShowsTheMeanOfAllTimes) {
  constexpr int kTimes = 64;
  for (const auto& [name, text] :
       {std::pair("node", turning_node()), {"skin", skinned()}, {"morph", morphed()}, {"step", stepping()}}) {
    put_file(directory / "a.gltf", text);
    TestScene sharp(scene_of("a.gltf", 4 * kTimes, 2 * kTimes, ""), directory / "test.dsc");
    for (const int second : {0, 1}) {
      Image mean(16, 16);
      for (int i = 0; i < kTimes; ++i) {
        const Image image = sharp.render(FileFrame(2 * kTimes * second + 2 * i + 1), 16);
        for (std::size_t k = 0; k < mean.pixels.size(); ++k) mean.pixels[k] += image.pixels[k] / kTimes;
      }
      const Image image = render(scene_of("a.gltf", 2, 1, R"("float shutterclose" 1)"), second, 2048);
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
          EXPECT_NEAR(static_cast<double>(image.at(x, y).g), static_cast<double>(mean.at(x, y).g), 0.04)
              << name << ", second " << second << ": " << x << ", " << y;
    }
  }
}

// Keys between frames do not change the frames.
TEST_F(GltfShutter, NodesAreInTheirPlacesInFrames) {
  put_file(directory / "a.gltf", turning_node());
  put_file(directory / "test.dsc", scene_of("a.gltf", 25, 12, ""));
  Diagnostics diagnostics;
  const SceneDescription scene = parse_files({(directory / "test.dsc").string()}, {}, diagnostics);
  for (int frame = 0; frame < 24; ++frame) {
    const Matrix4 matrix = scene.shapes.front().world_from_object.at(Moment(frame));
    const double angle = std::acos(-1.0) / 6 * frame, x = 0.6 + 0.7, y = 0.1;  // of the middle of the right side
    EXPECT_NEAR(matrix.m[0][0] + matrix.m[0][3], std::cos(angle) * x - std::sin(angle) * y, 1e-6) << frame;
    EXPECT_NEAR(matrix.m[1][0] + matrix.m[1][3], std::sin(angle) * x + std::cos(angle) * y, 1e-6) << frame;
    for (const double part : {0.25, 0.5, 0.75}) {
      const Matrix4 later = scene.shapes.front().world_from_object.at(Moment(frame + part));
      const double then = angle + std::acos(-1.0) / 6 * part;
      EXPECT_NEAR(later.m[0][0] + later.m[0][3], std::cos(then) * x - std::sin(then) * y, 1e-6)
          << frame << ", " << part;
    }
  }
}

TEST_F(GltfShutter, KeepsEveryPromise) {
  put_file(directory / "a.gltf", skinned());
  const std::string text = scene_of((directory / "a.gltf").string(), 3, 3, R"("float shutterclose" 0.75)");
  for (const auto check : {check_threads, check_resume, check_joint, check_crop}) {
    const Verdict verdict = check(text, 3);
    EXPECT_TRUE(verdict.passed) << verdict.message;
  }
}

}  // namespace gltf_shutter_test
}  // namespace dspm::test
