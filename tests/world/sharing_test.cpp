// What --explain says of small scenes whose sharing is plain, and what the scenes of frame intervals hold.
#include <gtest/gtest.h>

#include "testing/scenes.h"
#include "testing/test_scene.h"
#include "world/world.h"

namespace dspm {
namespace {

using test::TestScene;

std::string explained(TestScene& test, const std::vector<Frame>& frames) {
  std::string all;
  for (const std::string& line : test.world().explain(frames)) all += line + "\n";
  return all;
}

constexpr const char* kContents = R"(
DynamicBegin "still" Shape "sphere" "float radius" 0.1 Shape "disk" "float radius" 0.2 DynamicEnd
DynamicBegin "moving"
  Keyframe 1 Translate 0 0 0 Keyframe 3 Translate 1 0 0 KeyframeEnd
  Shape "sphere" "float radius" 0.3 Shape "disk" "float radius" 0.2
DynamicEnd
DynamicBegin "growing" Shape "sphere" "float radius@1" 0.1 "float radius@6" 0.6 DynamicEnd
DynamicBegin "late" "integer frames" [5 6] Shape "sphere" "float radius" 0.1 DynamicEnd
)";

TEST(Sharing, SaysWhatIsSharedAndWhy) {
  TestScene test(test::box("Frames 6\n", kContents));
  const std::string all = explained(test, test.all_frames());
  EXPECT_NE(all.find("dynamic \"still\": the same in all frames"), std::string::npos) << all;
  EXPECT_NE(all.find("dynamic \"moving\": moves rigidly, 3 states"), std::string::npos) << all;
  EXPECT_NE(all.find("dynamic \"growing\": 6 states of its geometry"), std::string::npos) << all;
  EXPECT_NE(all.find("dynamic \"late\": there in 2 of 6 frames, "), std::string::npos) << all;
  EXPECT_NE(all.find("camera: the same in all frames"), std::string::npos) << all;
}

TEST(Sharing, IsToldOfTheFramesThatAreRendered) {
  TestScene test(test::box("Frames 6\n", kContents));
  EXPECT_NE(explained(test, {3, 4}).find("dynamic \"moving\": the same in all frames"), std::string::npos);
  EXPECT_NE(explained(test, {0, 1}).find("dynamic \"late\": not there"), std::string::npos);
  EXPECT_NE(explained(test, {2}).find("dynamic \"growing\": the same in all frames"), std::string::npos);
}

TEST(World, ScenesOfIntervalsAgreeInWhatSamplingDerives) {
  TestScene test(test::box("Frames 6\n", kContents));
  const auto all = test.scene(test.all_frames()), some = test.scene({1, 4});
  EXPECT_EQ(all->center, some->center);
  EXPECT_EQ(all->radius, some->radius);
  ASSERT_EQ(all->lights.size(), some->lights.size());
  for (std::size_t i = 0; i < all->lights.size(); ++i)
    EXPECT_EQ(all->lights[i].probability, some->lights[i].probability);
  EXPECT_EQ(some->frame_count(), 2);
  for (const PlacedShape& shape : some->shapes) EXPECT_FALSE((shape.frames & some->frames()).empty());
}

}  // namespace
}  // namespace dspm
