// Interpolation, poses and the choice of animations.
#include "dspm/lang/gltf/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dspm/lang/gltf/extent.h"
#include "dspm/lang/gltf/poses.h"
#include "tests/gltf/gltf_file.h"

namespace dspm::gltf {
namespace {

using test::GltfFile;

/// Nodes of which the first is animated, from 0 s to 2 s.
Document moving(const std::string& path, const std::vector<float>& values, const char* type, int width,
                const std::string& interpolation) {
  GltfFile file;
  file.add_floats({0, 2}, "SCALAR", 1);
  file.add_floats(values, type, width);
  return Document(
      "/nowhere/test.gltf",
      file.text(fmt::format(
          R"("nodes":[{{"children":[1]}},{{"translation":[0,1,0]}}],"animations":[{{"name":"a","channels":[)"
          R"({{"sampler":0,"target":{{"node":0,"path":"{}"}}}}],"samplers":[{{"input":0,"output":1,)"
          R"("interpolation":"{}"}}]}}])",
          path, interpolation)));
}

std::vector<double> at(const Document& d, double time) { return choose_animation(d, "").channels.front().at(time); }

TEST(Channels, Interpolate) {
  const std::vector<float> two{0, 0, 0, 4, 2, 0};
  EXPECT_EQ(at(moving("translation", two, "VEC3", 3, "LINEAR"), 0.5), (std::vector<double>{1, 0.5, 0}));
  EXPECT_EQ(at(moving("translation", two, "VEC3", 3, "STEP"), 1.9), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(at(moving("translation", two, "VEC3", 3, "LINEAR"), 9), (std::vector<double>{4, 2, 0}));
  // With tangents of 0, a cubic spline is 3 t^2 - 2 t^3; one that leaves at 1 a second adds t (1 - t)^2 times 2 s.
  const std::vector<float> cubic{0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 8, 0, 0, 0, 0, 0};
  EXPECT_NEAR(at(moving("translation", cubic, "VEC3", 3, "CUBICSPLINE"), 0.5)[0], 8 * (3 / 16. - 2 / 64.) + 2 * 9 / 64.,
              1e-12);
}

TEST(Channels, RotationsTakeTheShorterWay) {
  const auto h = static_cast<float>(std::sqrt(0.5));
  for (const float sign : {1.f, -1.f}) {
    const auto q = at(moving("rotation", {0, 0, 0, 1, 0, 0, sign * h, sign * h}, "VEC4", 4, "LINEAR"), 1);
    EXPECT_NEAR(q[2], std::sin(std::acos(-1.0) / 8), 1e-6);
    EXPECT_NEAR(q[3], std::cos(std::acos(-1.0) / 8), 1e-6);
  }
}

TEST(Poses, ChildrenFollowTheirParents) {
  const Document d = moving("scale", {1, 1, 1, 3, 3, 3}, "VEC3", 3, "LINEAR");
  const Poses poses(d, choose_animation(d, ""), 3, 1);
  EXPECT_TRUE(poses.moves(0));
  EXPECT_FALSE(poses.moves(1));
  for (int frame = 0; frame < 3; ++frame) EXPECT_DOUBLE_EQ(poses.world(1, frame).m[1][3], 1.0 + frame);
}

TEST(Animations, OthersPlayIfTheyMoveOtherThings) {
  GltfFile file;
  file.add_floats({0, 1}, "SCALAR", 1), file.add_floats({0, 0, 0, 1, 1, 1}, "VEC3", 3);
  const auto animation = [](const char* name, int node) {
    return fmt::format(R"({{"name":"{}","channels":[{{"sampler":0,"target":{{"node":{},"path":"translation"}}}}],)"
                       R"("samplers":[{{"input":0,"output":1}}]}})",
                       name, node);
  };
  const Document d("/nowhere/test.gltf",
                   file.text(fmt::format(R"("nodes":[{{}},{{}}],"animations":[{},{},{}])", animation("walk", 0),
                                         animation("run", 0), animation("wave", 1))));
  EXPECT_EQ(choose_animation(d, "").played, (std::vector<std::string>{"walk", "wave"}));
  EXPECT_EQ(choose_animation(d, "").left_out, (std::vector<std::string>{"run"}));
  EXPECT_EQ(choose_animation(d, "run").played, (std::vector<std::string>{"run"}));
  EXPECT_EQ(frames_of(1, 24, 100), 25);
  EXPECT_THROW(frames_of(1e6, 24, 100), std::runtime_error);
}

TEST(Moments, PointersSetWhatIsThere) {
  GltfFile file;
  file.add_floats({0, 1}, "SCALAR", 1), file.add_floats({0, 1}, "SCALAR", 1);
  const auto set = [&](const char* pointer) {
    const Document d("/nowhere/test.gltf",
                     file.text(fmt::format(
                         R"("materials":[{{}}],"animations":[{{"channels":[{{"sampler":0,"target":{{"path":"pointer",)"
                         R"("extensions":{{"KHR_animation_pointer":{{"pointer":"{}"}}}}}}}}],)"
                         R"("samplers":[{{"input":0,"output":1}}]}}])",
                         pointer)));
    Json json = d.json();
    set_moment(json, choose_animation(d, ""), 0.25);
    return json["materials"].dump();
  };
  EXPECT_EQ(set("/materials/0/pbrMetallicRoughness/roughnessFactor"),
            R"([{"pbrMetallicRoughness":{"roughnessFactor":0.25}}])");
  EXPECT_EQ(set("/materials/99999/alphaCutoff"), "[{}]");
}

/// `count` vectors of numbers in [-1, 1].
Numbers random_numbers(std::mt19937& random, std::size_t count, std::size_t width) {
  std::uniform_real_distribution<float> number(-1, 1);
  Numbers numbers{count, width, {}};
  for (std::size_t i = 0; i < count * width; ++i) numbers.values.push_back(number(random));
  return numbers;
}

// Some vertices hang on no joint, and joints may be flat.
TEST(PosedBoxes, HoldAllVerticesInAllPoses) {
  constexpr std::size_t kVertices = 200, kJoints = 3;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-2, 2);
  for (const bool is_skinned : {false, true}) {
    Primitive rest;
    rest.positions = random_numbers(random, kVertices, 3);
    for (int target = 0; target < 2; ++target) rest.targets.push_back({random_numbers(random, kVertices, 3), {}, {}});
    if (is_skinned) {
      rest.weights = {random_numbers(random, kVertices, 4)}, rest.joints = {Numbers{kVertices, 4, {}}};
      for (std::size_t i = 0; i < 4 * kVertices; ++i)
        rest.joints[0].values.push_back(static_cast<float>(random() % kJoints));
    }
    const PosedBoxes boxes(rest);
    for (int pose_number = 0; pose_number < 50; ++pose_number) {
      const std::vector<double> weights{number(random), number(random)};
      std::vector<Matrix4> skin;
      for (std::size_t joint = 0; is_skinned && joint < kJoints; ++joint)
        skin.push_back(Matrix4::translate(100 * number(random), number(random), 0) *
                       Matrix4::rotate(90 * number(random), number(random), 1, 0) *
                       Matrix4::scale(joint == 0 ? 0 : number(random), 1, 1));
      const Bounds3 box = boxes.posed(weights, skin);
      Primitive posed = rest;
      pose(posed, weights, skin);
      Bounds3 tight, both = box;
      for (std::size_t i = 0; i < kVertices; ++i)
        tight.add(Vec3{posed.positions[i][0], posed.positions[i][1], posed.positions[i][2]});
      both.add(tight);
      EXPECT_EQ(both.low, box.low);
      EXPECT_EQ(both.high, box.high);
      EXPECT_LT(length(box.extent()), (is_skinned ? 10 : 2) * length(tight.extent()));
    }
  }
}

}  // namespace
}  // namespace dspm::gltf
