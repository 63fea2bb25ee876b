// What is said not to blur, "bool blur" false: while the shutter is open, it is as at the frame's own moment.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/canonical.h"
#include "dspm/session/exposure.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace sharp_blocks_test {

/// A picture of -4 <= x <= 4, -1 <= y <= 1, four pixels a unit. `contents` emit light; below them, a square crosses it,
/// so the shutter opens.
std::string flat(const std::string& contents, const std::string& camera = R"("float shutterclose" 1)") {
  return fmt::format(R"(
Frames 2
Integrator "path"
PixelFilter "box"
Film "rgb" "integer xresolution" 32 "integer yresolution" 8
LookAt 0 0 -5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-4 4 -1 1] {}
WorldBegin
AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
DynamicBegin "crossing"
  Keyframe 1 Translate -2 0 0 Keyframe 2 Translate 2 0 0 KeyframeEnd
  Shape "bilinearmesh" "point3 P" [-.5 -2 0 .5 -2 0 -.5 -.5 0 .5 -.5 0]
DynamicEnd
{}
)",
                     camera, contents);
}

constexpr const char* kKeys = "Keyframe 1 Translate -2 0 0 Keyframe 2 Translate 2 0 0 KeyframeEnd\n";
constexpr const char* kUpper = R"(Shape "bilinearmesh" "point3 P" [-.5 0 0 .5 0 0 -.5 2 0 .5 2 0])";

Image rendered(const std::string& text, int frame = 0) { return TestScene(text).render(FileFrame(frame), 16); }
float upper(const Image& image, int x) { return image.at(x, 1).g; }

/// Its left edge is at x = -2.5 in the first frame, pixel 6, and at 1.5, pixel 22, in the second.
void expect_sharp(const std::string& contents) {
  for (const int frame : {0, 1}) {
    const Image image = rendered(flat(contents), frame);
    const int left = frame == 0 ? 6 : 22;
    for (int x = 0; x < 32; ++x) EXPECT_EQ(upper(image, x), x >= left && x < left + 4 ? 1 : 0) << contents << x;
    // The other square blurs: 16 times show it all along its way, in the first frame.
    float lower = 0;
    for (int x = 12; x < 20; ++x) lower += image.at(x, 7).g;
    EXPECT_NEAR(lower, frame == 0 ? 8 * 0.25f : 0, 0.6f) << contents;
  }
}

TEST(SharpBlocks, AreShownAtTheMomentOfTheFrame) {
  expect_sharp(fmt::format(R"(DynamicBegin "sharp" "bool blur" false {} {} DynamicEnd)", kKeys, kUpper));
  expect_sharp(fmt::format(R"(DynamicBegin "sharp" {} {} "bool blur" false DynamicEnd)", kKeys, kUpper));
  expect_sharp(
      fmt::format(R"(DynamicBegin "sharp" {} Attribute "shape" "bool blur" false {} DynamicEnd)", kKeys, kUpper));
}

TEST(SharpBlocks, HoldInstancesAndBlocksWithinThem) {
  const std::string object = fmt::format("ObjectBegin \"o\" {} ObjectEnd\n", kUpper);
  expect_sharp(object +
               fmt::format(R"(DynamicBegin "sharp" "bool blur" false {} ObjectInstance "o" DynamicEnd)", kKeys));
  expect_sharp(fmt::format(R"(ObjectBegin "o" {} "bool blur" false ObjectEnd
DynamicBegin "sharp" {} ObjectInstance "o" DynamicEnd)",
                           kUpper, kKeys));
  expect_sharp(fmt::format(R"(DynamicBegin "outer" "bool blur" false DynamicBegin "inner" {} {} DynamicEnd DynamicEnd)",
                           kKeys, kUpper));
}

TEST(SharpBlocks, MayHoldWhatBlurs) {
  const std::string text = flat(fmt::format(
      R"(DynamicBegin "outer" "bool blur" false DynamicBegin "inner" "bool blur" true {} {} DynamicEnd DynamicEnd)",
      kKeys, kUpper));
  const std::string plain = flat(fmt::format(R"(DynamicBegin "outer" {} {} DynamicEnd)", kKeys, kUpper));
  EXPECT_EQ(rendered(text), rendered(plain));
  EXPECT_LT(upper(rendered(text), 7), 1);
}

TEST(SharpBlocks, HoldParametersOfShapesAndLamps) {
  const Image image = rendered(flat(R"(
DynamicBegin "sharp" "bool blur" false
  Translate 0 .6 0
  AreaLightSource "diffuse" "rgb L@1" [3 3 3] "rgb L@2" [9 9 9] "bool twosided" true
  Shape "disk" "float radius@1" 0.5 "float radius@2" 3
DynamicEnd
)"));
  EXPECT_EQ(upper(image, 16), 3);
  EXPECT_EQ(upper(image, 20), 0);
}

// A lamp that goes away, over a wall that stays.
TEST(SharpBlocks, HoldLights) {
  const auto wall = [](const char* block) {
    return fmt::format(R"(
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [0 0 0]
  Shape "bilinearmesh" "point3 P" [-9 -9 1 9 -9 1 -9 9 1 9 9 1]
AttributeEnd
DynamicBegin "lamp" {}
  Keyframe 1 Translate 0 0 -2 Keyframe 2 Translate 0 0 -9 KeyframeEnd
  LightSource "point" "rgb I@1" [9 9 9] "rgb I@2" [1 1 1]
DynamicEnd
)",
                       block);
  };
  const auto lit = [&](const char* block, const char* camera) {
    std::string text = flat(wall(block), camera);
    text.replace(text.find("[1 1 1]"), 7, "[0 0 0]");  // by the lamp alone
    return rendered(text);
  };
  const char* const kOpen = R"("float shutterclose" 1)";
  const Image sharp = lit(R"("bool blur" false)", kOpen), closed = lit("", ""), open = lit("", kOpen);
  for (const int x : {10, 16, 25}) {
    EXPECT_NEAR(upper(sharp, x), upper(closed, x), 1e-5f);
    EXPECT_LT(upper(open, x), 0.7f * upper(closed, x));
  }
}

std::vector<std::string> explained(const std::string& text) { return explain_shutter(TestScene(text).job()); }

TEST(SharpBlocks, LeaveTheShutterClosedIfNothingElseMoves) {
  std::string text = flat(fmt::format(R"(DynamicBegin "sharp" "bool blur" false {} {} DynamicEnd)", kKeys, kUpper));
  const std::vector<std::string> lines = explained(text);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines.front().find("meanwhile 1 shape may change"), std::string::npos) << lines.front();
  text.replace(text.find("\"crossing\""), 10, "\"crossing\" \"bool blur\" false");
  TestScene sharp(text);
  EXPECT_EQ(explained(text), std::vector<std::string>());
  EXPECT_FALSE(sharp.job().shutter.delays());
}

TEST(SharpBlocks, OfObjectsAreNotCountedAmongWhatMoves) {
  const auto line = [](const char* blur) {
    return explained(flat(fmt::format(R"(ObjectBegin "o" {} {} ObjectEnd
DynamicBegin "sharp" {} ObjectInstance "o" DynamicEnd)",
                                      kUpper, blur, kKeys)))
        .front();
  };
  EXPECT_NE(line(R"("bool blur" false)").find("meanwhile 1 shape may"), std::string::npos);
  EXPECT_NE(line("").find("meanwhile 2 shapes may"), std::string::npos);
}

// Vectors of motion go from the frame's moment to the next one's: 16 pixels.
TEST(SharpBlocks, HaveTheirVectorsOfMotion) {
  Choices choices;
  choices.outputs = {"motion"};
  TestScene test(flat(fmt::format(R"(DynamicBegin "sharp" "bool blur" false {} {} DynamicEnd)", kKeys, kUpper)),
                 choices);
  const auto scene = test.scene(test.all_frames());
  const auto integrator = test.integrator(*scene);
  test.iterate(*integrator, *scene, 0, 8);
  for (const int x : {6, 9}) EXPECT_NEAR(integrator->estimate(0, "motion.forward").at(x, 1).r, 16, 1e-3);
  for (const int x : {22, 25}) EXPECT_NEAR(integrator->estimate(1, "motion.backward").at(x, 1).r, -16, 1e-3);
}

TEST(SharpBlocks, KeepEveryPromise) {
  const std::string text =
      flat(fmt::format(R"(DynamicBegin "sharp" "bool blur" false {} {} DynamicEnd)", kKeys, kUpper));
  for (const auto check : {check_threads, check_resume, check_joint, check_crop}) {
    const Verdict verdict = check(text, 3);
    EXPECT_TRUE(verdict.passed) << verdict.message;
  }
}

TEST(SharpBlocks, AreOtherScenesToCheckpoints) {
  const auto digests = [](const char* block) {
    TestScene test(flat(fmt::format(R"(DynamicBegin "a" {} {} {} DynamicEnd)", block, kKeys, kUpper)));
    const SceneDescription& description = *test.job().description;
    std::vector<std::uint64_t> all;
    for (const ElementDigest& each : digests_of(description, description.frames.base())) all.push_back(each.digest);
    return all;
  };
  EXPECT_NE(digests(R"("bool blur" false)"), digests(""));
  EXPECT_EQ(digests(R"("bool blur" true)"), digests(""));
}

TEST(SharpBlocks, RefuseWhatIsNeitherTrueNorFalse) {
  const auto error = [](const std::string& block, const std::string& shape) -> std::string {
    try {
      TestScene test(flat(fmt::format(R"(DynamicBegin "a" {} {} {} {} DynamicEnd)", block, kKeys, kUpper, shape)));
    } catch (const SceneError& thrown) {
      return thrown.what();
    }
    return "";
  };
  const auto expect = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  const char* const kOne = "\"blur\" must be one bool, the same in all frames";
  expect(error("", R"("string blur" "no")"), kOne);
  expect(error("", R"("bool blur" [true false])"), kOne);
  expect(error("", R"("bool blur@2" false)"), kOne);
  expect(error(R"("string blur" "no")", ""), "blur");
  expect(error(R"("bool blur" [true false])", ""), "blur");
  expect(error(R"("bool blur@2" false)", ""), "parameters of DynamicBegin cannot change between frames");
  EXPECT_EQ(error(R"("bool blur" false)", R"("bool blur" true)"), "");
}

}  // namespace sharp_blocks_test
}  // namespace dspm::test
