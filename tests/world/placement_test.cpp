// Where shapes and objects stand in the world, and which side of them is outside.
#include <gtest/gtest.h>

#include "dspm/testing/test_scene.h"

namespace dspm {
namespace {

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

TEST(Placement, OnlySkiesAnswerRaysThatLeaveTheScene) {
  const Placed lamps("LightSource \"infinite\" AreaLightSource \"diffuse\" Shape \"sphere\"");
  EXPECT_EQ(lamps.scene().lights.size(), 3u);  // the first is a point
  EXPECT_EQ(lamps.scene().infinite_lights, std::vector<int>{1});
}

}  // namespace
}  // namespace dspm
