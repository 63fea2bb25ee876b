// Which frames choose lights for their photon paths alike.
#include "dspm/world/lighting/light_choices.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "dspm/base/math/moments.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace light_choices_test {

constexpr const char* kBegin = "Camera \"perspective\"\nWorldBegin\n";
constexpr const char* kThings = "Shape \"sphere\" \"float radius\" 0.1\n";

/// `count` variations, each with a lamp of its own and, all of them, one of power `common`.
std::string lamps(int count, double common = 0) {
  std::string lights = fmt::format("LightSource \"point\" \"rgb I\" [{0} {0} {0}]\n", common), variations;
  for (int i = 0; i < count; ++i) {
    lights += fmt::format(
        "DynamicBegin \"{0}\" LightSource \"point\" \"rgb I\" [1 1 1] \"point3 from\" [{0} 0 0] DynamicEnd\n", i);
    variations += fmt::format("VariationBegin \"v{0}\" Show \"{0}\" VariationEnd\n", i);
  }
  return kBegin + lights + variations + kThings;
}

/// Every frame is in one choice, in which each of its lights has a chance; shares add up to 1.
void expect_complete(TestScene& test) {
  const auto scene = test.scene(test.all_frames());
  FrameSet all;
  double shares = 0;
  for (const LightChoice& choice : scene->light_choices) {
    EXPECT_TRUE((all & choice.frames).empty());
    all |= choice.frames;
    shares += static_cast<double>(choice.share);
    double sum = 0;
    for (std::size_t i = 0; i < scene->lights.size(); ++i) {
      sum += static_cast<double>(choice.probability()[i]);
      scene->lights[i].states.for_each(choice.frames, [&](FrameSet, const Light& light) {
        if (luminance(light.power()) > 0) {
          EXPECT_GT(choice.probability()[i], 0) << i;
        }
      });
    }
    EXPECT_NEAR(sum, 1, 1e-5);
  }
  EXPECT_EQ(all, scene->frames());
  EXPECT_NEAR(shares, 1, 1e-6);
  for (const SceneLight& light : scene->lights) {
    double sum = 0;
    for (const float share : light.choice_shares) sum += static_cast<double>(share);
    if (light.probability > 0) {
      EXPECT_NEAR(sum, 1, 1e-6);
    }
  }
}

TEST(LightChoices, AreOneIfLightsDifferLittle) {
  for (const char* light : {R"("rgb I" [1 1 1])", R"("rgb I" [1 1 1] "float scale@1" 1 "float scale@6" 1.5)"}) {
    TestScene test("Frames 6\n" + std::string(kBegin) + "LightSource \"point\" " + light +
                   "\nLightSource \"point\" \"rgb I\" [2 2 2]\n" + kThings);
    EXPECT_EQ(test.scene(test.all_frames())->light_choices.size(), 1U) << light;
    expect_complete(test);
  }
}

// All of a frame's light comes from its own lamp, so all of its photons do.
TEST(LightChoices, GiveEachOfEightLampsAllPhotonsOfItsFrame) {
  TestScene test(lamps(8));
  const auto scene = test.scene(test.all_frames());
  ASSERT_EQ(scene->light_choices.size(), 8U);
  for (std::size_t c = 0; c < 8; ++c) {
    EXPECT_EQ(scene->light_choices[c].frames, FrameSet::single(static_cast<Frame>(c)));
    EXPECT_EQ(scene->light_choices[c].probability()[c + 1], 1);
    EXPECT_EQ(scene->light_choices[c].choose(0.7f).index, static_cast<int>(c) + 1);
    EXPECT_EQ(scene->lights[c + 1].choice_shares[c], 1);
  }
  expect_complete(test);
}

// Lamps of power 1 of 13: 13^2 / (12^2 13/12 + 8 13) = 0.65 of the photons remain, more than 0.6.
TEST(LightChoices, StayTogetherIfLittleIsLost) {
  TestScene test(lamps(8, 12));
  EXPECT_EQ(test.scene(test.all_frames())->light_choices.size(), 1U);
}

TEST(LightChoices, AreAtMostSixteen) {
  TestScene test(lamps(40));
  EXPECT_EQ(test.scene(test.all_frames())->light_choices.size(), LightChoices::kMostChoices);
  expect_complete(test);
  TestScene faint(lamps(40, 0.5));
  expect_complete(faint);
}

TEST(LightChoices, DoNotDependOnTheFramesRendered) {
  TestScene test(lamps(8));
  const auto all = test.scene(test.all_frames());
  const auto some = test.scene({FileFrame(2), FileFrame(5)});
  ASSERT_EQ(some->light_choices.size(), all->light_choices.size());
  for (std::size_t c = 0; c < 8; ++c) {
    EXPECT_EQ(some->light_choices[c].probability(), all->light_choices[c].probability());
    EXPECT_EQ(some->light_choices[c].share, all->light_choices[c].share);
    EXPECT_EQ(some->light_choices[c].frames.empty(), c != 2 && c != 5);
  }
}

// A moment of light among 300 dark ones, which no even spread over the file would meet.
TEST(LightChoices, AreAllAmongTheSampleFrames) {
  LightChoices choices;
  choices.of_frame.assign(300, 0), choices.base = 300;
  choices.of_frame[123] = 1, choices.of_frame[298] = 2;
  choices.probabilities = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<FileFrame> sample = choices.sample();
  EXPECT_EQ(sample.size(), 16U);
  std::set<int> frames;
  for (const FileFrame frame : sample) frames.insert(frame.index());
  EXPECT_EQ(frames.size(), 16U);
  EXPECT_TRUE(frames.contains(123) && frames.contains(298) && frames.contains(0));
}

// Two lights of powers 3 and 1. By power a path has a variance of 16; half and half, of 2 (9 + 1).
TEST(LightChoices, WorthIsThatOfTheVariance) {
  EXPECT_DOUBLE_EQ(worth_of_choice({3, 1}, {0.75f, 0.25f}), 1);
  EXPECT_DOUBLE_EQ(worth_of_choice({3, 1}, {0.5f, 0.5f}), 16. / 20);
  EXPECT_DOUBLE_EQ(worth_of_choice({3, 1}, {1, 0}), 0);
  EXPECT_DOUBLE_EQ(worth_of_choice({0, 0}, {1, 0}), 1);
}

}  // namespace light_choices_test
}  // namespace dspm::test
