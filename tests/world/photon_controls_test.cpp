// "float photons" and "bool caustics": what they set, at any light and any shape, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/lights/light.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace photon_controls_test {

constexpr const char* kFourFrames = "Frames 4\nCamera \"perspective\"\nWorldBegin\n";
constexpr const char* kBalls = "Shape \"sphere\" \"float radius\" 0.1\n";

std::string point(double intensity, const std::string& words = "") {
  return fmt::format("LightSource \"point\" \"rgb I\" [{0} {0} {0}] {1}\n", intensity, words);
}

// Powers of 1 : 2 : 4 (a disk of area pi emits pi^2, a point 4 pi), photons of 3, 1 and 0.5.
TEST(PhotonControls, MultiplyTheShareOfThePaths) {
  const std::string lights = fmt::format(
      "{}{}AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [{l} {l} {l}] \"float photons\" 0.5\n"
      "Shape \"disk\" AttributeEnd\n",
      point(1, "\"float photons\" 3"), point(2), fmt::arg("l", 16 / 3.14159265));
  TestScene test(kFourFrames + lights + kBalls);
  for (const std::vector<FileFrame>& frames : {test.all_frames(), {FileFrame(2)}}) {
    const auto scene = test.scene(frames);
    const double powers[] = {1, 2, 4}, weights[] = {3, 2, 2};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(scene->light_choices.front().probability()[i], weights[i] / 7, 1e-6) << i;
      EXPECT_NEAR(scene->lights[i].probability, powers[i] / 7, 1e-6) << i;
    }
    int chosen[3] = {};
    constexpr int kNumbers = 7 << 12;
    for (int n = 0; n < kNumbers; ++n)
      ++chosen[scene->light_choices.front().choose((static_cast<float>(n) + 0.5f) / kNumbers).index];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(chosen[i], weights[i] * (1 << 12), 2) << i;
  }
}

// Of more than eight lights, four samples go by what they send.
TEST(PhotonControls, LeaveShadowRaysAlone) {
  const auto samples = [](const std::string& words) {
    std::string lights = point(9, words);
    for (int i = 0; i < 9; ++i) lights += point(1);
    TestScene test(kFourFrames + lights + kBalls);
    const auto scene = test.scene({FileFrame(0)});
    std::vector<float> all;
    for (const SceneLight& light : scene->lights) all.push_back(light_samples(*scene, light, {{0.3f, 0.1f, 0}}));
    return all;
  };
  EXPECT_EQ(samples(""), samples("\"float photons\" 100"));
  EXPECT_NEAR(samples("").front(), 4 * 0.5, 1e-4) << "all are in one place";
}

class Lamp final : public Light {
 public:
  Rgb power() const override { return Rgb(1); }
  std::optional<Emission> emit(Vec2, Vec2) const override { return {}; }
  std::optional<Illumination> illuminate(const Vec3&, Vec2) const override { return {}; }
};

std::unique_ptr<Light> make_lamp(ParamReader& reader, const LightContext&) {
  reader.finish();
  return std::make_unique<Lamp>();
}

// Even of one that knows nothing of them, as those of other people do not.
TEST(PhotonControls, AreTakenFromLightsOfAnyPlugin) {
  light_plugins().add({"lamp", "a light without parameters", make_lamp});
  std::string lights;
  int count = 0;
  for (const auto& plugin : light_plugins()) {
    if (plugin.name == "goniometric" || plugin.name == "projection") continue;  // they need pictures
    ++count;
    lights += fmt::format("LightSource \"{}\" \"float photons\" {} \"bool caustics\" {}\n", plugin.name, count,
                          count % 2 == 0);
  }
  ASSERT_GE(count, 5);
  TestScene test(kFourFrames + lights + kBalls);
  const auto scene = test.scene({FileFrame(0)});
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(scene->lights[static_cast<std::size_t>(i)].photons, static_cast<float>(i + 1));
    EXPECT_EQ(scene->lights[static_cast<std::size_t>(i)].caustics, (i + 1) % 2 == 0);
  }
}

TEST(PhotonControls, AreDefaultsOfAttribute) {
  TestScene test(std::string(kFourFrames) + "Attribute \"light\" \"float photons\" 2 \"bool caustics\" false\n" +
                 point(1) + point(1, "\"float photons\" 5 \"bool caustics\" true") + kBalls);
  const auto scene = test.scene({FileFrame(0)});
  EXPECT_EQ(scene->lights[0].photons, 2);
  EXPECT_FALSE(scene->lights[0].caustics);
  EXPECT_EQ(scene->lights[1].photons, 5);
  EXPECT_TRUE(scene->lights[1].caustics);
}

// Spheres by their radius: those above 1 make no caustics.
TEST(PhotonControls, AreTakenFromShapesWhereverTheyAre) {
  TestScene test(std::string(kFourFrames) + R"(
Shape "sphere" "float radius" .1
Shape "sphere" "float radius" 2 "bool caustics" false
DynamicBegin "moving" Keyframe 1 Translate 0 0 0 Keyframe 4 Translate 1 0 0 KeyframeEnd
  Shape "sphere" "float radius" 3 "bool caustics" false
  Shape "sphere" "float radius@1" .2 "float radius@4" .4
  Shape "sphere" "float radius@1" 4 "float radius@4" 5 "bool caustics" false
DynamicEnd
ObjectBegin "thing"
  Shape "sphere" "float radius" .3 "bool caustics" true
  Shape "sphere" "float radius" 6 "bool caustics" false
ObjectEnd
ObjectInstance "thing"
Translate 1 0 0
ObjectInstance "thing"
AttributeBegin
  Attribute "shape" "bool caustics" false
  Shape "sphere" "float radius" 7
  Shape "sphere" "float radius" .5 "bool caustics" true
AttributeEnd
)");
  const auto scene = test.scene(test.all_frames());
  EXPECT_EQ(scene->shapes.size(), 1u + 1 + 4 + 4 + 4 + 2 * 2 + 2);
  for (const PlacedShape& shape : scene->shapes)
    EXPECT_EQ(shape.caustics, shape.bounds(0).extent().x / 2 < 1) << shape.bounds(0).extent().x;
}

TEST(PhotonControls, LightsHaveNamesOfTheirOwn) {
  TestScene test(std::string(kFourFrames) + point(1) + point(1) + point(1, "\"string name\" \"key\"") + R"(
AttributeBegin AreaLightSource "diffuse" Shape "disk" Shape "sphere" "string name" "globe" AttributeEnd
AttributeBegin AreaLightSource "diffuse" "string name" "key" Shape "disk" AttributeEnd
)");
  const auto scene = test.scene({FileFrame(0)});
  const std::vector<std::string> names(scene->light_names.begin(), scene->light_names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"point", "point.2", "key", "disk", "globe", "key.2"}));
}

struct Mistake {
  const char* directive;
  const char* message;  // from the column on
};

class PhotonMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(PhotonMistakes, AreTold) {
  std::string text = "Frames 4\nWorldBegin\n";
  text += std::string("DynamicBegin \"b\"\n") + GetParam().directive + "\nDynamicEnd\n";
  try {
    TestScene test(text);
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()), GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, PhotonMistakes,
    testing::Values(
        Mistake{"LightSource \"point\" \"float photons\" -2",
                "test.dsc:4:21: error: photons must be above 0: without photons, light would be missing\n"
                "    4 | LightSource \"point\" \"float photons\" -2\n"
                "      |                     ^~~~~~~~~~~~~~~\n"
                "  \"float scale\" 0 turns a light off, \"bool caustics\" false takes its caustics out\n"},
        Mistake{"LightSource \"point\" \"float photons\" 0",
                "test.dsc:4:21: error: photons must be above 0: without photons, light would be missing\n"
                "    4 | LightSource \"point\" \"float photons\" 0\n"
                "      |                     ^~~~~~~~~~~~~~~\n"
                "  \"float scale\" 0 turns a light off, \"bool caustics\" false takes its caustics out\n"},
        Mistake{"LightSource \"point\" \"float photons\" 1e39",
                "test.dsc:4:37: error: this number is too large\n"
                "    4 | LightSource \"point\" \"float photons\" 1e39\n"
                "      |                                     ^~~~\n"},
        Mistake{"AreaLightSource \"diffuse\" \"float photons@2\" 3 Shape \"disk\"",
                "test.dsc:4:27: error: \"photons\" must be the same in all frames\n"
                "    4 | AreaLightSource \"diffuse\" \"float photons@2\" 3 Shape \"disk\"\n"
                "      |                           ^~~~~~~~~~~~~~~~~\n"},
        Mistake{"Shape \"sphere\" \"bool caustics@2\" false",
                "test.dsc:4:16: error: \"caustics\" must be the same in all frames\n"
                "    4 | Shape \"sphere\" \"bool caustics@2\" false\n"
                "      |                ^~~~~~~~~~~~~~~~~\n"},
        Mistake{"LightSource \"point\" \"float photons\" 1e9 LightSource \"distant\"",
                "test.dsc:4:41: error: the lights' \"photons\" leave light \"distant\" less than one photon path in a "
                "million\n"
                "    4 | LightSource \"point\" \"float photons\" 1e9 LightSource \"distant\"\n"
                "      |                                         ^~~~~~~~~~~\n"
                "  by power it would have 20%\n"},
        Mistake{"LightSource \"area\" \"rgb L\" [1 1 1]",
                "test.dsc:4:13: error: \"area\" is a light that shapes emit, and no LightSource\n"
                "    4 | LightSource \"area\" \"rgb L\" [1 1 1]\n"
                "      |             ^~~~~~\n"
                "  AreaLightSource \"diffuse\" makes lights of the shapes that follow it in its block\n"},
        Mistake{"Shape \"sphere\" \"float caustics\" 1",
                "test.dsc:4:16: error: parameter \"caustics\" of shape \"sphere\" must be bool, not float\n"
                "    4 | Shape \"sphere\" \"float caustics\" 1\n"
                "      |                ^~~~~~~~~~~~~~~~\n"}));

}  // namespace photon_controls_test
}  // namespace dspm::test
