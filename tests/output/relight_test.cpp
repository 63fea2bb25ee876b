// --relight: an image's light groups mixed again are the image that other lights would give.
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/params/errors.h"
#include "dspm/image/exr.h"
#include "dspm/output/group_factor.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace relight_test {

/// Two frames of two groups, "key" and "cold", and an area light without a group; in Rec. 2020, exposed and balanced.
std::string scene(const char* key, const char* cold) {
  return std::string(R"(
Frames 2
ColorSpace "rec2020"
Integrator "path" "integer iterations" 8 "integer seed" 5
LookAt 0 1 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 12 "integer yresolution" 8 "string filename" "a.exr" "float iso" 150 "float whitebalance" 5000
WorldBegin
LightSource "point" "string group" "key" "rgb I" )") +
         key + R"( "point3 from" [2 3 -2]
LightSource "point" "string group" "cold" "rgb I" )" +
         cold + R"( "point3 from" [-2 3 -2]
AttributeBegin AreaLightSource "diffuse" "rgb L" [3 2 1] Translate 0 3 0 Shape "sphere" "float radius" .4 AttributeEnd
Material "diffuse" "rgb reflectance" [.7 .6 .5]
DynamicBegin "ball" Keyframe 1 Translate 0 0 0 Keyframe 2 Translate 1 0 0 KeyframeEnd Shape "sphere" "float radius" .8 DynamicEnd
Translate 0 -1 0 Rotate 90 1 0 0 Shape "disk" "float radius" 9
)";
}

TemporaryDirectory& rendered() {
  static TemporaryDirectory directory;
  static const bool done = [] {
    put_file(directory / "a.dsc", scene("[20 20 20]", "[20 20 20]"));
    const Outcome outcome = run(directory, {"a.dsc", "--aov", "lights,N,object", "--float", "--compression", "piz"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return true;
  }();
  static_cast<void>(done);
  return directory;
}

Image colours(const TemporaryDirectory& directory, const std::string& file) {
  return read_exr_channels(directory / file, {"R", "G", "B"});
}

void expect_near(const Image& a, const Image& b, float tolerance) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(a.pixels[i][c], b.pixels[i][c], tolerance * std::max(1.f, std::abs(a.pixels[i][c]))) << i;
}

TEST(Relight, WritesThePngThatARenderWrites) {
  TemporaryDirectory& directory = rendered();
  const Outcome outcome =
      run(directory, {"--relight", "a.0001.exr", "key 1", "-o", "shown.exr", "--png", "--view", "filmic"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "dspm: shown.exr\ndspm: shown.png\n");
  const TemporaryDirectory other;
  put_file(other / "a.dsc", scene("[20 20 20]", "[20 20 20]"));
  ASSERT_EQ(run(other, {"a.dsc", "--frames", "1", "--png", "--view", "filmic"}).code, 0);
  expect_near(read_image(directory / "shown.png"), read_image(other / "a.0001.png"), 0.01f);
}

TEST(Relight, ByOneChangesNothing) {
  TemporaryDirectory& directory = rendered();
  const Outcome outcome = run(directory, {"--relight", "a.0001.exr", "key 1", "-o", "same.exr"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_near(colours(directory, "same.exr"), colours(directory, "a.0001.exr"), 1e-5f);
  const ExrHeader before = read_exr_header(directory / "a.0001.exr"), after = read_exr_header(directory / "same.exr");
  EXPECT_EQ(after.channels, before.channels);
  EXPECT_EQ(after.precisions, before.precisions);
  EXPECT_EQ(after.texts, before.texts);
  EXPECT_EQ(after.matrices, before.matrices);
  EXPECT_EQ(after.space, ColourSpace::rec2020);
  EXPECT_EQ(after.format.compression, ExrCompression::piz);
  for (const std::vector<std::string>& layer : {std::vector<std::string>{"N.X", "N.Y", "N.Z"}, {"object.X"}})
    EXPECT_EQ(read_exr_channels(directory / "same.exr", layer), read_exr_channels(directory / "a.0001.exr", layer));
}

// Point lights of other strengths take no other random numbers here: each of the few lights is sampled, and only the
// choice of the shadow ray differs. So the means are compared.
TEST(Relight, IsWhatOtherLightsGive) {
  TemporaryDirectory& directory = rendered();
  ASSERT_EQ(run(directory, {"--relight", "a.0001.exr", "key 0", "cold .5", "-o", "b.exr"}).code, 0);
  TemporaryDirectory other;
  put_file(other / "a.dsc", scene("[0 0 0]", "[10 10 10]"));
  ASSERT_EQ(run(other, {"a.dsc", "--float", "--iterations", "256", "--frames", "1"}).code, 0);
  const auto mean = [](const Image& image) {
    Rgb sum;
    for (const Rgb& pixel : image.pixels) sum += pixel / static_cast<float>(image.pixels.size());
    return sum;
  };
  const Rgb mixed = mean(colours(directory, "b.exr")), made = mean(colours(other, "a.0001.exr"));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mixed[c] / made[c], 1, 0.1f);
}

TEST(Relight, IsLinearAndCanBeDoneAgain) {
  TemporaryDirectory& directory = rendered();
  ASSERT_EQ(run(directory, {"--relight", "a.0002.exr", "key 0.5 [1 .8 .6]", "cold 3", "-o", "b.exr"}).code, 0);
  ASSERT_EQ(run(directory, {"--relight", "a.0002.exr", "key .5", "-o", "c.exr"}).code, 0);
  ASSERT_EQ(run(directory, {"--relight", "c.exr", "key [1 .8 .6]", "cold 3", "-o", "d.exr"}).code, 0);
  expect_near(colours(directory, "b.exr"), colours(directory, "d.exr"), 1e-5f);
  const Image key = read_exr_channels(directory / "a.0002.exr", {"light_key.R", "light_key.G", "light_key.B"});
  const Image cold = read_exr_channels(directory / "a.0002.exr", {"light_cold.R", "light_cold.G", "light_cold.B"});
  Image expected = colours(directory, "a.0002.exr");
  for (std::size_t i = 0; i < expected.pixels.size(); ++i)
    expected.pixels[i] += key.pixels[i] * (Rgb(.5f, .4f, .3f) - Rgb(1)) + cold.pixels[i] * 2.f;
  expect_near(colours(directory, "b.exr"), expected, 1e-5f);
}

TEST(Relight, OfSeveralImagesNumbersThem) {
  TemporaryDirectory& directory = rendered();
  const Outcome outcome = run(directory, {"--relight", "a.0001.exr", "a.0002.exr", "key 2", "-o", "mix.exr"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(colours(directory, "mix.0001.exr"), colours(directory, "mix.0002.exr"));
}

/// As the renders were named: by variation and moment, or by a template of their choices.
TEST(Relight, NamesVariationsAsTheyWereNamed) {
  const TemporaryDirectory directory;
  put_file(directory / "a.dsc", scene("[20 20 20]", "[20 20 20]") + R"(
AxisBegin "coat" VariationBegin "red" Show "ball" VariationEnd VariationBegin "none" Hide "ball" VariationEnd AxisEnd
AxisBegin "key" VariationBegin "on" Show "ball" VariationEnd VariationBegin "off" Hide "ball" VariationEnd AxisEnd
)");
  ASSERT_EQ(run(directory, {"a.dsc", "--aov", "lights", "--iterations", "1"}).code, 0);
  const auto mixed = [&](const Arguments& images, const std::string& name) {
    return run(directory, Arguments{"--relight"} + images + Arguments{"key 2", "-o", name}).err;
  };
  EXPECT_EQ(mixed({"a.none-on.0001.exr", "a.red-off.0001.exr"}, "b.exr"), "dspm: b.none-on.exr\ndspm: b.red-off.exr\n");
  EXPECT_EQ(mixed({"a.none-on.0002.exr"}, "b.exr"), "dspm: b.none-on.exr\n");
  EXPECT_EQ(mixed({"a.none-on.0001.exr", "a.none-on.0002.exr"}, "b.exr"),
            "dspm: b.none-on.0001.exr\ndspm: b.none-on.0002.exr\n");
  EXPECT_EQ(mixed({"a.none-on.0002.exr"}, "b/{coat}/{key}-{frame:1}.exr"), "dspm: b/none/on-2.exr\n");
}

TEST(Relight, KeepsTransparency) {
  const TemporaryDirectory directory;
  put_file(directory / "a.dsc", scene("[20 20 20]", "[20 20 20]"));
  ASSERT_EQ(
      run(directory, {"a.dsc", "--frames", "1", "--iterations", "1", "--aov", "lights", "--transparent", "--png"}).code,
      0);
  ASSERT_EQ(run(directory, {"--relight", "a.0001.exr", "key 1", "-o", "b.exr", "--png"}).code, 0);
  const Image before = read_image(directory / "a.0001.png"), after = read_image(directory / "b.png");
  ASSERT_FALSE(before.alpha.empty());
  EXPECT_EQ(after.alpha, before.alpha);
}

TEST(Relight, RefusesWhatItCannotMix) {
  TemporaryDirectory& directory = rendered();
  const auto refused = [&](const Arguments& arguments, const char* why) {
    const Outcome outcome = run(directory, Arguments{"--relight"} + arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
  };
  refused({"a.0001.exr", "kye 2", "-o", "b.exr"}, "it has no light group \"kye\"; it has other, cold, key");
  refused({"a.0001.exr", "key 2", "-o", "a.0001.exr"}, "a.0001.exr");
  refused({"a.0001.exr", "-o", "b.exr"}, "how?");
  refused({"key 2", "-o", "b.exr"}, "which images?");
  refused({"a.0001.exr", "key 2"}, "-o names");
  put_file(directory / "plain.dsc", scene("[1 1 1]", "[1 1 1]"));
  ASSERT_EQ(run(directory, {"plain.dsc", "-o", "plain.exr", "--frames", "1"}).code, 0);
  refused({"plain.0001.exr", "key 2", "-o", "b.exr"}, "--aov lights");
  ASSERT_EQ(run(directory, {"plain.dsc", "--aov", "light_other,light_key", "-o", "part.exr", "--frames", "1"}).code, 0);
  refused({"part.0001.exr", "key 2", "-o", "b.exr"}, "the layer light_cold is missing");
  put_file(directory / "broken.exr", "no image");
  EXPECT_EQ(run(directory, {"--relight", "broken.exr", "key 2", "-o", "b.exr"}).code, 1);
}

TEST(Relight, FactorsAreANumberAndAColour) {
  const auto expect = [](const char* text, const Rgb& factor) {
    const GroupFactor parsed = parse_group_factor(text);
    EXPECT_EQ(parsed.group, "key");
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(parsed.factor[c], factor[c]) << text;
  };
  expect("key 0.5", Rgb(.5f));
  expect("key [1 .5 0]", {1, .5f, 0});
  expect(" key 2[ 1 .5 .25 ] ", {2, 1, .5f});
  for (const char* text : {"key", "", "key x", "key -1", "key nan", "key 1e99", "key [1 2]", "key [1 2 3 4]", "key 1 2",
                           "key [1 2 3", "key [1 2 3] 4", "key [1,2,3]"})
    EXPECT_THROW(parse_group_factor(text), UsageError) << text;
}

}  // namespace relight_test
}  // namespace dspm::test
