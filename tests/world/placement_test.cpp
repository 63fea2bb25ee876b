// Where shapes and objects stand in the world, and which side of them is outside.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/session/load.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace placement_test {

using test::TestScene;

constexpr const char* kObjects = R"(
ObjectBegin "ball" Translate 1 0 0 Shape "sphere" ObjectEnd
ObjectBegin "turned ball" ReverseOrientation Shape "sphere" ObjectEnd
)";

/// The shapes of a scene with these objects.
class Placed {
 public:
  explicit Placed(const std::string& contents)
      : test_(std::string("WorldBegin LightSource \"point\"\n") + kObjects + contents),
        scene_(test_.scene(test_.all_frames())) {}
  const Scene& scene() const { return *scene_; }
  const PlacedShape& operator[](std::size_t i) const { return scene_->shapes.at(i); }
  std::size_t size() const { return scene_->shapes.size(); }

 private:
  TestScene test_;  // owns what the scene refers to
  std::unique_ptr<Scene> scene_;
};

// The object's point x goes to S (T x), S the instance's scale and T the object's own shift: the origin to (2, 0, 0).
TEST(Placement, AnInstanceMovesWhatTheObjectHasPlaced) {
  const Placed shapes("Scale 2 2 2 ObjectInstance \"ball\"");
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(shapes[0].to_world.point({0, 0, 0}), (Vec3{2, 0, 0}));
}

TEST(Placement, OrientationIsReversedByTheObjectOrItsInstanceNotByBoth) {
  const Placed shapes(R"(
ObjectInstance "ball"
ObjectInstance "turned ball"
ReverseOrientation
ObjectInstance "ball"
ObjectInstance "turned ball")");
  ASSERT_EQ(shapes.size(), 4u);  // in the order of objects, then of instances
  EXPECT_FALSE(shapes[0].flip_normals);
  EXPECT_TRUE(shapes[1].flip_normals);
  EXPECT_TRUE(shapes[2].flip_normals);
  EXPECT_FALSE(shapes[3].flip_normals);
}

TEST(Placement, ReversedOrientationTurnsBothNormals) {
  for (const char* contents : {"Shape \"sphere\"", "Scale 1 2 3 Shape \"sphere\""}) {
    const Placed shapes(contents), reversed(std::string("ReverseOrientation ") + contents);
    const Vec2 middle{0, 0.5f};  // the sphere's point at +x
    const SurfacePoint point = shapes[0].surface_point(0, middle), turned = reversed[0].surface_point(0, middle);
    EXPECT_GT(point.ng.x, 0.99f) << contents;
    EXPECT_EQ(turned.ng, -point.ng) << contents;
    EXPECT_EQ(turned.ns, -point.ns) << contents;
  }
}

// Half the diagonal of the box around everything: of a cube of side 4 it is 2 sqrt(3).
TEST(Placement, TheSphereAroundTheSceneGoesThroughTheCornersOfItsBox) {
  const Placed ball("Translate 7 0 0 Shape \"sphere\" \"float radius\" 2");
  EXPECT_NEAR(ball.scene().center.x, 7, 1e-5f);
  EXPECT_NEAR(ball.scene().radius, 2 * std::sqrt(3.f), 1e-5f);
}

// Smaller ones would be lost in the rounding of the coordinates.
TEST(Placement, TheSphereAroundTheSceneIsNotSmallerThanItsPlaceAllows) {
  const Placed speck("Translate 1000 0 0 Shape \"sphere\" \"float radius\" 1e-9");
  EXPECT_NEAR(speck.scene().radius, 1e-6f * 1001, 1e-8f);
}

/// What is said of a scene of three frames with such a block.
std::string said_of(const std::string& block) {
  Diagnostics diagnostics;
  std::string text;
  try {
    const LoadedScene loaded("test.dsc", "Frames 3\nWorldBegin LightSource \"infinite\"\n" + block, {}, diagnostics);
  } catch (const SceneError&) {}
  for (const Diagnostic& each : diagnostics.all()) text += fmt::format("{}: {}\n", each.where.line, each.message);
  return text;
}

constexpr const char* kVanishing = "Keyframe 1 Scale 1 1 1 Keyframe 3 Scale -1 -1 -1 KeyframeEnd";

// As exporters hide things, and as keys pass through it.
TEST(Placement, AScaleOfZeroHides) {
  EXPECT_EQ(said_of("DynamicBegin \"a\" " + std::string(kVanishing) + "\nShape \"sphere\" DynamicEnd"),
            "4: a scale of 0 hides shape \"sphere\" in 1 of 3 frames\n");
  for (const char* keys : {"Keyframe 1 Scale 0 0 0 Keyframe 2 Scale 2 2 2 KeyframeEnd",
                           "Keyframe 1 Scale 0 0 0 Keyframe 2 Rotate 50 0 1 0 KeyframeEnd Scale 2 2 2"})
    EXPECT_EQ(said_of(std::string("DynamicBegin \"a\" ") + keys + "\nShape \"sphere\" DynamicEnd"),
              "4: a scale of 0 hides shape \"sphere\" in 1 of 3 frames\n");
  EXPECT_EQ(said_of("DynamicBegin \"a\" " + std::string(kVanishing) + "\nLightSource \"point\" DynamicEnd"),
            "0: the scene has no shape\n4: a scale of 0 hides light \"point\" in 1 of 3 frames\n");
  EXPECT_EQ(said_of("ObjectBegin \"ball\" Shape \"sphere\" Shape \"disk\" ObjectEnd\nDynamicBegin \"a\" " +
                    std::string(kVanishing) + "\nObjectInstance \"ball\" DynamicEnd"),
            "5: a scale of 0 hides object \"ball\" in 1 of 3 frames\n");
  const TestScene test("Frames 3 WorldBegin LightSource \"infinite\" DynamicBegin \"a\" " + std::string(kVanishing) +
                       " AreaLightSource \"diffuse\" Shape \"sphere\" DynamicEnd Shape \"disk\"");
  EXPECT_EQ(test.scene({FileFrame(0)})->shapes.size(), 2u);
  EXPECT_EQ(test.scene({FileFrame(1)})->shapes.size(), 1u);
}

// Each block is sound by itself; the error has a place, and hides no other.
TEST(Placement, SingularProductsOfBlocksAreErrorsWithTheirPlace) {
  const std::string shrinking = "DynamicBegin \"a\" Keyframe 1 Scale 1 1 1 Keyframe 3 Scale 1e-19 1 1 KeyframeEnd\n";
  const std::string inner = "AttributeBegin Keyframe 1 Scale 1 1 1 Keyframe 3 Scale 1e-19 1 1 KeyframeEnd\n";
  const std::string said =
      said_of(shrinking + inner + "Shape \"sphere\"\nShape \"disk\" \"float radius\" -1\nAttributeEnd DynamicEnd");
  EXPECT_NE(said.find("5: the transform of shape \"sphere\" is singular in frame 3\n"), std::string::npos) << said;
  EXPECT_NE(said.find("6: "), std::string::npos) << said;
}

TEST(Placement, OnlySkiesAnswerRaysThatLeaveTheScene) {
  const Placed lamps("LightSource \"infinite\" AreaLightSource \"diffuse\" Shape \"sphere\"");
  EXPECT_EQ(lamps.scene().lights.size(), 3u);  // the first is a point
  EXPECT_EQ(lamps.scene().infinite_lights, std::vector<int>{1});
}

}  // namespace placement_test
}  // namespace dspm
