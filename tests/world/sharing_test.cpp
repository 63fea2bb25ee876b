// What --explain says of small scenes whose sharing is plain, and what the scenes of frame intervals hold.
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"
#include "dspm/world/world.h"

namespace dspm {
namespace sharing_test {

using test::TestScene;

std::string explained(TestScene& test, const std::vector<int>& indices) {
  std::vector<FileFrame> frames;
  for (const int index : indices) frames.emplace_back(index);
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
  const std::string all = explained(test, {0, 1, 2, 3, 4, 5});
  EXPECT_NE(all.find("dynamic \"still\": the same in all frames"), std::string::npos) << all;
  EXPECT_NE(all.find("dynamic \"moving\": moves rigidly, 3 states"), std::string::npos) << all;
  EXPECT_NE(all.find("dynamic \"growing\": 6 states of its geometry"), std::string::npos) << all;
  EXPECT_NE(all.find("dynamic \"late\": present in 2 of 6 frames, "), std::string::npos) << all;
  EXPECT_NE(all.find("camera: the same in all frames"), std::string::npos) << all;
  EXPECT_EQ(all.find("file of its own"), std::string::npos) << all;
}

TEST(Sharing, NamesWhatIsStatic) {
  TestScene test(
      "Frames 2\nWorldBegin\nLightSource \"infinite\"\nShape \"sphere\" \"string name\" \"seat\"\n"
      "Shape \"disk\"\n");
  EXPECT_NE(explained(test, {0, 1}).find("static: 2 primitives in 2 shapes (seat, disk): shared"), std::string::npos)
      << explained(test, {0, 1});
}

TEST(Sharing, IsToldOfTheFramesThatAreRendered) {
  TestScene test(test::box("Frames 6\n", kContents));
  EXPECT_NE(explained(test, {3, 4}).find("dynamic \"moving\": the same in all frames"), std::string::npos);
  EXPECT_NE(explained(test, {0, 1}).find("dynamic \"late\": absent"), std::string::npos);
  EXPECT_NE(explained(test, {2}).find("dynamic \"growing\": the same in all frames"), std::string::npos);
}

TEST(Sharing, NamesTheLightsOfBlocksWithoutShapes) {
  TestScene test(test::box("Frames 6\n", R"(
DynamicBegin "sun" Keyframe 1 Translate 0 0 0 Keyframe 6 Translate 1 0 0 KeyframeEnd
LightSource "point" "string name" "key" DynamicEnd
DynamicBegin "lamp" LightSource "point" DynamicEnd
DynamicBegin "flash" "integer frames" [5 6] LightSource "point" "string name" "bulb" DynamicEnd
DynamicBegin "cart" DynamicBegin "wheel" Shape "sphere" "float radius" 0.1 DynamicEnd DynamicEnd
AreaLightSource "diffuse" "string name" "panel" "rgb L@1" [1 1 1] "rgb L@6" [2 2 2]
Shape "disk" "float radius" 0.1)"));
  const std::string all = explained(test, {0, 1, 2, 3, 4, 5});
  const auto says = [&](const std::string& text) { return all.find(text) != std::string::npos; };
  EXPECT_TRUE(says("dynamic \"sun\": no shapes, but light \"key\".\n")) << all;
  EXPECT_TRUE(says("dynamic \"lamp\": no shapes, but light \"point\", the same in all frames.\n")) << all;
  EXPECT_TRUE(says("dynamic \"cart\": nothing but the Dynamic blocks in it.\n")) << all;
  EXPECT_TRUE(says("\nlight \"key\": 6 states")) << all;
  EXPECT_TRUE(says("\narea light \"panel\": 6 states")) << all;
  EXPECT_FALSE(says("absent")) << all;
  EXPECT_NE(explained(test, {0, 1}).find("dynamic \"flash\": absent"), std::string::npos);
}

// A spline through equal poses, and the rounds of a cycle, are shared as what stands still is.
TEST(Sharing, CountsNoStateTwice) {
  TestScene test(test::box("Frames 12\n", R"(
DynamicBegin "still" Keyframe 1 "string ease" "cubic" Rotate 33 1 2 3 Keyframe 5 "string ease" "cubic" Rotate 33 1 2 3
Keyframe 9 Rotate 33 1 2 3 KeyframeEnd Shape "sphere" "float radius" 0.1 DynamicEnd
DynamicBegin "swings" Keyframe 1 "string ease" "cubic" Rotate 0 0 0 1 Keyframe 2 "string ease" "cubic" Rotate 33 0 0 1
Keyframe 5 Rotate 0 0 0 1 KeyframeEnd "string after" "repeat" Shape "disk" "float radius" 0.1 DynamicEnd
)"));
  const std::string all = explained(test, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  EXPECT_NE(all.find("dynamic \"still\": the same in all frames"), std::string::npos) << all;
  EXPECT_NE(all.find("dynamic \"swings\": moves rigidly, 4 states"), std::string::npos) << all;
}

std::string lamp(const std::string& name) {
  return "LightSource \"point\" \"rgb I\" [1 1 1] \"string name\" \"" + name + "\"\n";
}

std::string dark_variation(const std::string& name, const std::vector<std::string>& dark) {
  std::string text = "VariationBegin \"" + name + "\" ";
  for (const std::string& each : dark) text += "Light \"" + each + "\" \"float scale\" 0 ";
  return text + "VariationEnd\n";
}

// One lamp of a third of the power is left of three: photon paths choose it as often as each of the others, so a third
// of them carry its flux.
TEST(Sharing, TellsWhatPhotonsAreWorthWhereLightsDiffer) {
  TestScene three("WorldBegin Shape \"sphere\"\n" + lamp("a") + lamp("b") + lamp("c") +
                  dark_variation("one", {"b", "c"}) + dark_variation("two", {"a", "c"}) +
                  dark_variation("three", {"a", "b"}));
  // Each would be worth 1 / 3 with the others, so each is a group of its own, and worth as much as in its own file.
  EXPECT_NE(explained(three, {2}).find("3 groups, each of which chooses lights for its photons"), std::string::npos)
      << explained(three, {2});
  EXPECT_EQ(explained(three, {2}).find("fares worst"), std::string::npos) << explained(three, {2});
  // Mean powers of 1 and 1/2, so chances of 2/3 and 1/3. With both lit: (1 + 1)^2 / (1 / (2/3) + 1 / (1/3)) = 8/9, with
  // one: 1 / (1 / (2/3)) = 2/3.
  TestScene two("WorldBegin Shape \"sphere\"\n" + lamp("a") + lamp("b") +
                "VariationBegin \"both\" Light \"a\" \"float scale\" 1 VariationEnd\n" + dark_variation("one", {"b"}));
  EXPECT_NE(explained(two, {0, 1})
                .find("over the 2 frames of the file. Frame one fares worst: the flux of its lights "
                      "is as noisy as with 67% of"),
            std::string::npos)
      << explained(two, {0, 1});
  EXPECT_NE(explained(two, {0}).find("Frame both fares worst: the flux of its lights is as noisy as with 89% of"),
            std::string::npos)
      << explained(two, {0});
}

// Boxes of 2 x 2 x 2 in the first frame and 2 x 6 x 2 in both: spheres of radius sqrt(3) and sqrt(11), disks of 3 : 11.
TEST(Sharing, TellsWhichPhotonsFromFarAwayReachAFrame) {
  const std::string scene = R"(Frames 3
WorldBegin
Shape "sphere"
DynamicBegin "ball" Keyframe 1 Translate 0 0 0 Keyframe 3 Translate 0 4 0 KeyframeEnd Shape "sphere" DynamicEnd
)";
  for (const char* far : {"LightSource \"distant\"", "LightSource \"infinite\""}) {
    TestScene rises(scene + far);
    EXPECT_NE(explained(rises, {0, 1, 2}).find("in any of the 3 frames of the file. Frame 1 fares worst: 27% of them"),
              std::string::npos)
        << explained(rises, {0, 1, 2});
    EXPECT_EQ(explained(rises, {2}).find("file of its own"), std::string::npos) << "the last frame has all";
    EXPECT_EQ(explained(rises, {0, 1, 2}).find("lights: photon paths"), std::string::npos) << "there is one light";
  }
  TestScene near(scene + lamp("a"));
  EXPECT_EQ(explained(near, {0, 1, 2}).find("its own"), std::string::npos);
}

TEST(World, ScenesOfIntervalsAgreeInWhatSamplingDerives) {
  TestScene test(test::box("Frames 6\n", kContents));
  const auto all = test.scene(test.all_frames()), some = test.scene({FileFrame(1), FileFrame(4)});
  EXPECT_EQ(all->center, some->center);
  EXPECT_EQ(all->radius, some->radius);
  ASSERT_EQ(all->lights.size(), some->lights.size());
  for (std::size_t i = 0; i < all->lights.size(); ++i)
    EXPECT_EQ(all->lights[i].probability, some->lights[i].probability);
  EXPECT_EQ(some->frame_count(), 2);
  for (const PlacedShape& shape : some->shapes) EXPECT_FALSE((shape.frames & some->frames()).empty());
}

}  // namespace sharing_test
}  // namespace dspm
