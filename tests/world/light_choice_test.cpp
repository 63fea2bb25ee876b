// Lights are chosen in proportion to their luminous power, its mean over the frames of the file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace light_choice_test {

const double kPiD = std::acos(-1.);

/// The luminance of linear sRGB. [IEC 61966-2-1]
double luminance_of(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }

constexpr const char* kBefore = R"(
Camera "perspective"
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
)";

// The sphere around everything: half of the diagonal of these walls' bounds, 8 x 6 x 10.
constexpr const char* kWalls = R"(
Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [-4 -3 -5  4 -3 -5  4 3 -5]
Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [-4 -3 5  4 -3 5  4 3 5]
)";
const double kRadius = std::hypot(8, 6, 10) / 2;

struct KnownLight {
  const char* text;
  double power;  // luminous, the mean over the frames
};

// In four frames. Each power is a strength's luminance times what the light spreads it over.
const KnownLight kDirectives[] = {
    // All directions: 4 pi I. The scale goes from 1 to 4.
    {R"(LightSource "point" "rgb I" [1 2 3] "float scale@1" 1 "float scale@4" 4)",
     4 * kPiD* luminance_of(1, 2, 3) * 2.5},
    // The inner cone, and half of the ring around it: 3 x^2 - 2 x^3 has the mean 1/2.
    {R"(LightSource "spot" "rgb I" [30 20 10] "float coneangle" 60 "float conedeltaangle" 15)",
     2 * kPiD*(1 - (std::cos(kPiD / 4) + std::cos(kPiD / 3)) / 2) * luminance_of(30, 20, 10)},
    {R"(LightSource "point" "rgb I" [0 0 0])", 0},
    // The disk across the light that covers the scene.
    {R"(LightSource "distant" "rgb L" [.5 .4 .3])", kPiD* kRadius* kRadius* luminance_of(.5, .4, .3)},
    // That disk, from all directions.
    {R"(LightSource "infinite" "rgb L" [.01 .02 .04])", 4 * kPiD* kPiD* kRadius* kRadius* luminance_of(.01, .02, .04)},
    {R"(LightSource "point" "rgb I" [1 1 1] "float power" 77)", 77},
};

const KnownLight kEmitters[] = {
    // A half space from each place: pi A L. Two of four frames.
    {R"(DynamicBegin "lamp" "integer frames" [2 3]
AreaLightSource "diffuse" "rgb L" [5 4 3] Shape "disk" "float radius" 2
DynamicEnd)",
     kPiD * 4 * kPiD* luminance_of(5, 4, 3) / 2},
    // Both sides of a rectangle of 2 x 3.
    {R"(AttributeBegin AreaLightSource "diffuse" "rgb L" [3 3 1] "bool twosided" true
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [0 0 0 2 0 0 2 3 0 0 3 0] AttributeEnd)",
     2 * kPiD * 6 * luminance_of(3, 3, 1)},
    {R"(AttributeBegin AreaLightSource "diffuse" "rgb L" [1 2 1] Shape "sphere" "float radius" 0.5 AttributeEnd)",
     kPiD * 4 * kPiD * 0.25 * luminance_of(1, 2, 1)},
};

std::string all_lights() {
  std::string text = std::string("Frames 4") + kBefore + "WorldBegin\n";
  for (const KnownLight& light : kDirectives) text += std::string(light.text) + "\n";
  for (const KnownLight& light : kEmitters) text += std::string(light.text) + "\n";
  return text + kWalls;
}

/// In the order of the scene's lights: directives, then emitters.
std::vector<double> known_probabilities() {
  std::vector<double> probabilities;
  for (const KnownLight& light : kDirectives) probabilities.push_back(light.power);
  for (const KnownLight& light : kEmitters) probabilities.push_back(light.power);
  double total = 0;
  for (const double power : probabilities) total += power;
  for (double& probability : probabilities) probability /= total;
  return probabilities;
}

// Whether rays can find a light is a fact of the light, not of a frame.
TEST(LightChoice, ASunIsADiskInAllFramesOrInNone) {
  const auto angles = [](const char* words) {
    return std::string("Frames 4") + kBefore + "WorldBegin\nLightSource \"distant\" " + words + kWalls;
  };
  try {
    const TestScene refused(angles(R"("float angle@1" 0 "float angle@4" 3)"));
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("an \"angle\" of 0.01 is as sharp as 0"), std::string::npos)
        << error.what();
  }
  TestScene test(angles(R"("float angle@1" 0.01 "float angle@4" 3)"));
  const auto scene = test.scene(test.all_frames());
  EXPECT_EQ(scene->infinite_lights, std::vector{0});
  EXPECT_FALSE(scene->lights[0].is_delta);
}

TEST(LightChoice, GoesByMeanPower) {
  TestScene test(all_lights());
  const std::vector<double> expected = known_probabilities();
  for (const std::vector<FileFrame>& frames : {test.all_frames(), {FileFrame(0)}, {FileFrame(2)}}) {
    const auto scene = test.scene(frames);
    ASSERT_EQ(scene->lights.size(), expected.size());
    double sum = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const auto probability = static_cast<double>(scene->lights[i].probability);
      EXPECT_NEAR(probability, expected[i], 1e-4 * expected[i]) << "light " << i;
      sum += probability;
    }
    EXPECT_NEAR(sum, 1, 1e-6);
  }
}

// Of n numbers in even steps, n p fall into a light's part of [0, 1), but for those at its two ends.
TEST(LightChoice, IsMadeAsOftenAsItSays) {
  TestScene test(all_lights());
  const auto scene = test.scene(test.all_frames());
  constexpr int kNumbers = 1 << 20;
  std::vector<int> chosen(scene->lights.size());
  for (int i = 0; i < kNumbers; ++i) {
    const ChosenLight choice = scene->light_choices.front().choose((static_cast<float>(i) + 0.5f) / kNumbers);
    ASSERT_EQ(choice.probability, scene->lights[static_cast<std::size_t>(choice.index)].probability);
    ++chosen[static_cast<std::size_t>(choice.index)];
  }
  for (std::size_t i = 0; i < chosen.size(); ++i)
    EXPECT_NEAR(chosen[i], static_cast<double>(scene->lights[i].probability) * kNumbers, 3) << "light " << i;
  EXPECT_EQ(chosen[2], 0) << "a black light was chosen";
}

// The sum of some numbers of equal probabilities is rounded to below the largest number that there is.
TEST(LightChoice, NeverEndsAtABlackLight) {
  std::string lights;
  for (int count = 1; count <= 40; ++count) {
    lights += "LightSource \"point\" \"rgb I\" [1 1 1]\n";
    TestScene test(kBefore + ("WorldBegin " + lights) + R"(LightSource "point" "rgb I" [0 0 0])" + kWalls);
    const ChosenLight last = test.scene({FileFrame(0)})->light_choices.front().choose(0x0.ffffffp0f);
    EXPECT_EQ(last.index, count - 1);
    EXPECT_NEAR(last.probability, 1. / count, 1e-6);
  }
}

TEST(LightChoice, FindsNothingInTheDark) {
  TestScene test(std::string(kBefore) + R"(WorldBegin LightSource "point" "rgb I" [0 0 0])" + kWalls);
  EXPECT_EQ(test.scene({FileFrame(0)})->light_choices.front().choose(0.5f).probability, 0);
}

// Three variations and two moments: the first light has the factors 1, 0.25 and 0, the second is always the same.
TEST(LightChoice, CountsVariationsAsFrames) {
  TestScene test(std::string("Frames 2") + kBefore + R"(WorldBegin
LightSource "point" "rgb I" [4 4 4] "string name" "key"
LightSource "point" "rgb I" [1 1 1] "string name" "fill"
VariationBegin "day" Light "key" "float scale" 1 VariationEnd
VariationBegin "dusk" Light "key" "float scale" .25 VariationEnd
VariationBegin "night" Light "key" "float scale" 0 VariationEnd
)" + kWalls);
  ASSERT_EQ(test.frame_count(), 6);
  const double key = 4 * (1 + 0.25 + 0) / 3;
  const auto scene = test.scene({FileFrame(1)});
  EXPECT_NEAR(static_cast<double>(scene->lights[0].probability), key / (key + 1), 1e-6);
  EXPECT_NEAR(static_cast<double>(scene->lights[1].probability), 1 / (key + 1), 1e-6);
}

}  // namespace light_choice_test
}  // namespace dspm::test
