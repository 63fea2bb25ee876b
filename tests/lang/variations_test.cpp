// Axes and variations as they are read, their products and names, and which of them patterns choose.
#include "dspm/lang/variations.h"

#include <fmt/format.h>

#include "dspm/base/math/moments.h"
#include "dspm/lang/formatter.h"
#include "tests/lang/parsing.h"

namespace dspm::test {
namespace {

constexpr const char* kChair = R"(
WorldBegin
LightSource "point" "string name" "key"
AreaLightSource "diffuse" "string name" "panel"
Texture "cloth" "spectrum" "constant"
Texture "bumps" "float" "constant"
MakeNamedMaterial "legs" "string type" "diffuse"
MakeNamedMaterial "seat" "string type" "diffuse"
DynamicBegin "cushion" Shape "sphere" DynamicEnd
)";

std::string axis(const std::string& name, const std::vector<std::string>& variations) {
  std::string text = "AxisBegin \"" + name + "\"\n";
  for (const std::string& each : variations)
    text += "  VariationBegin \"" + each + "\" MakeNamedMaterial \"seat\" \"string type\" \"conductor\" VariationEnd\n";
  return text + "AxisEnd\n";
}

std::vector<std::string> names(const SceneDescription& scene) {
  std::vector<std::string> list;
  for (const Combination& each : scene.frames.combinations()) list.push_back(each.name);
  return list;
}

using Names = std::vector<std::string>;

TEST(Variations, HoldWhatTheyReplace) {
  const SceneDescription scene = good(std::string("Frames 5\n") + kChair + R"(
AxisBegin "seat"
  VariationBegin "red"
    MakeNamedMaterial "seat" "string type" "conductor" "float roughness@2" 0.5
    Texture "cloth" "spectrum" "checkerboard"
    Texture "bumps" "float" "constant" "float value" 3
    Light "key" "float scale" 0.5
    Light "panel" "float scale@1" 2 "float scale@3" 4
    Show "cushion"
  VariationEnd
  VariationBegin "bare" Hide "cushion" VariationEnd
AxisEnd)");
  ASSERT_EQ(scene.axes.size(), 1u);
  EXPECT_EQ(scene.axes[0].name, "seat");
  ASSERT_EQ(scene.axes[0].variations.size(), 2u);
  const Variation &red = scene.axes[0].variations[0], &bare = scene.axes[0].variations[1];
  EXPECT_EQ(red.name, "red");
  ASSERT_EQ(red.materials.size(), 1u);
  EXPECT_EQ(red.materials[0].name, "seat");
  EXPECT_EQ(red.materials[0].type, "conductor");
  ASSERT_EQ(red.textures.size(), 2u);
  EXPECT_TRUE(red.textures[0].is_spectrum);
  EXPECT_EQ(red.textures[1].name, "bumps");
  ASSERT_EQ(red.lights.size(), 2u);
  EXPECT_EQ(floats(red.lights[0].params, "scale"), (std::vector<float>{.5f}));
  EXPECT_EQ(floats(red.lights[1].params.at(Moment(1)), "scale"), (std::vector<float>{3}));
  ASSERT_EQ(bare.switches.size(), 1u);
  EXPECT_FALSE(bare.switches[0].shown);
  // The scene's own are what they were.
  EXPECT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.textures.size(), 2u);
}

TEST(Variations, MultiplyInTheOrderOfTheText) {
  const SceneDescription scene = good(kChair + axis("legs", {"oak", "steel"}) + axis("seat", {"red", "blue", "glass"}));
  EXPECT_EQ(names(scene), (Names{"oak-red", "oak-blue", "oak-glass", "steel-red", "steel-blue", "steel-glass"}));
  EXPECT_EQ(scene.frames.count(), 6);
  EXPECT_EQ(scene.frames.choice(FileFrame(4), 0), 1);
  EXPECT_EQ(scene.frames.choice(FileFrame(4), 1), 1);
}

TEST(Variations, AndMomentsAreInTheLabelsOfFrames) {
  EXPECT_EQ(FileFrames(3, {{"", {}}}).label(FileFrame(2)), "3");
  const std::vector<Combination> woods{{"oak", {0}}, {"ash", {1}}};
  EXPECT_EQ(FileFrames(1, woods).label(FileFrame(1)), "ash");
  EXPECT_EQ(FileFrames(2, woods).label(FileFrame(0)), "oak 1");
  EXPECT_EQ(FileFrames(2, woods).label(FileFrame(3)), "ash 2");
}

TEST(Variations, MultiplyWithFrames) {
  const SceneDescription scene = good(std::string("Frames 10\n") + kChair + axis("seat", {"red", "blue"}));
  EXPECT_EQ(scene.frames.count(), 20);
  EXPECT_EQ(scene.frames.moments(), 10);
  EXPECT_EQ(scene.frames.moment(FileFrame(13)), Moment(3));
  EXPECT_EQ(scene.frames.variation(FileFrame(13)), "blue");
}

TEST(Variations, OfAFileOfOneFrameKeepItsNumberAndName) {
  const SceneDescription scene = good(std::string("Frames 10\n") + kChair + axis("seat", {"red", "blue"}));
  const FileFrames one = scene.frames.only(FileFrame(13));
  EXPECT_EQ(one.count(), 1);
  EXPECT_EQ(one.moment(FileFrame(0)), Moment(3));
  EXPECT_EQ(one.variation(FileFrame(0)), "blue");
  EXPECT_EQ(one.choice(FileFrame(0), 0), 1);
  EXPECT_EQ(one.only(FileFrame(0)).moment(FileFrame(0)), Moment(3));
}

TEST(Variations, OutsideOfAxesFormOneWithoutName) {
  const std::string bare = R"(VariationBegin "plain" Hide "cushion" VariationEnd
)";
  const std::string other = R"(VariationBegin "soft" Show "cushion" VariationEnd
)";
  const SceneDescription scene = good(kChair + bare + axis("seat", {"red", "blue"}) + other);
  ASSERT_EQ(scene.axes.size(), 2u);
  EXPECT_EQ(scene.axes[0].name, "");
  EXPECT_EQ(names(scene), (Names{"plain-red", "plain-blue", "soft-red", "soft-blue"}));
}

TEST(Variations, NoneMakeOneWithoutName) {
  const SceneDescription scene = good(std::string("Frames 3\n") + kChair);
  EXPECT_EQ(names(scene), (Names{""}));
  EXPECT_EQ(scene.frames.count(), 3);
}

TEST(Variations, MayStandBeforeWhatTheyReplace) {
  EXPECT_EQ(good("WorldBegin\n" + axis("seat", {"red"}) + "MakeNamedMaterial \"seat\" \"string type\" \"diffuse\"")
                .frames.count(),
            1);
}

TEST(Variations, TakeDefaultsAndTransformsInForce) {
  const SceneDescription scene = good(std::string(kChair) + R"(
Translate 1 2 3
Attribute "material" "float roughness" 0.3
VariationBegin "red"
  MakeNamedMaterial "seat" "string type" "conductor"
  Texture "cloth" "spectrum" "constant"
VariationEnd)");
  const Variation& red = scene.axes[0].variations[0];
  EXPECT_NE(red.materials[0].params.find("roughness"), nullptr);
  EXPECT_EQ(red.textures[0].world_from_texture.at(Moment()).m[0][3], 1);
}

std::vector<VariationAxis> axes(const std::vector<Names>& names) {
  std::vector<VariationAxis> result;
  for (const Names& each : names) {
    VariationAxis& axis = result.emplace_back();
    for (const std::string& name : each) axis.variations.emplace_back().name = name;
  }
  return result;
}

Names matching(const std::vector<Names>& of_axes, const Names& patterns, std::size_t most = 100) {
  Names found;
  for (const Combination& each : matching_combinations(axes(of_axes), patterns, most)) found.push_back(each.name);
  return found;
}

TEST(Patterns, ChooseByTheWholeName) {
  const std::vector<Names> all{{"oak", "steel"}, {"red", "blue"}};
  EXPECT_EQ(matching(all, {"oak-*"}), (Names{"oak-red", "oak-blue"}));
  EXPECT_EQ(matching(all, {"*e"}), (Names{"oak-blue", "steel-blue"}));
  EXPECT_EQ(matching(all, {"steel-red", "oak-???"}), (Names{"oak-red", "steel-red"}));
  EXPECT_EQ(matching(all, {"oak"}), Names{});
  EXPECT_EQ(matching(all, {"*"}, 3), (Names{"oak-red", "oak-blue", "steel-red"}));
}

TEST(Variations, MayReplaceNothing) {
  const SceneDescription scene = good(std::string(kChair) + "VariationBegin \"as it is\" VariationEnd" +
                                      " VariationBegin \"bare\" Hide \"cushion\" VariationEnd");
  EXPECT_EQ(names(scene), (Names{"as it is", "bare"}));
}

TEST(Variations, CombinationsAreExcludedOrChosen) {
  const std::string product = kChair + axis("legs", {"oak", "steel", "black"}) +
                              axis("seat", {"red-silk", "red-wool", "blue"}) + axis("back", {"oak", "none"});
  const auto left = [&](const std::string& rules) { return names(good(product + rules)); };
  EXPECT_EQ(left("").size(), 18u);
  EXPECT_EQ(left("AxisExclude \"steel\" \"red-*\"").size(), 14u);
  EXPECT_EQ(left("AxisExclude \"steel\" \"red-*\" \"none\"").size(), 16u);
  EXPECT_EQ(left("AxisExclude \"oak\"").size(), 6u);
  EXPECT_EQ(left("AxisExclude \"legs:oak\"").size(), 12u);
  EXPECT_EQ(left("AxisOnly \"oak\" \"blue\" \"none\" AxisOnly \"black\" \"red-wool\" AxisExclude \"back:oak\""),
            (Names{"oak-blue-none", "black-red-wool-none"}));
}

// 2^60 of them, of which the last axis's rule leaves nothing.
TEST(Variations, ExcludedOnesAreNotTriedForever) {
  std::string product = kChair;
  for (int i = 0; i < 60; ++i) product += axis("axis" + std::to_string(i), {"a", "b"});
  product += axis("last", {"z"});
  const Parsed parsed = parse(product + "AxisExclude \"z\"");
  ASSERT_EQ(parsed.diagnostics.error_count(), 1);
  EXPECT_NE(parsed.messages().find("leave too few: 4000000 combinations were tried"), std::string::npos)
      << parsed.messages();
}

// 10^24 of them: only what matches may be walked through.
TEST(Patterns, FindAFewAmongVeryMany) {
  Names tens;
  for (int i = 0; i < 10; ++i) tens.push_back(std::string(1, static_cast<char>('a' + i)));
  const std::vector<Names> all(24, tens);
  std::string name = "j";
  for (int i = 1; i < 24; ++i) name += "-b";
  EXPECT_EQ(matching(all, {name}), Names{name});
  EXPECT_EQ(matching(all, {"*-nothing"}), Names{});
  EXPECT_EQ(matching(all, {"*-x", name.substr(0, name.size() - 1) + "?"}).size(), 10u);
}

TEST(Patterns, MakeTheChosenOfTooMany) {
  std::string text = kChair;
  for (int a = 0; a < 5; ++a)
    text += axis(std::string(1, static_cast<char>('a' + a)), {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"});
  Diagnostics diagnostics;
  const auto scene = parse_text("scene.dsc", text, {{}, {"1-2-3-4-*", "0-0-0-0-0"}}, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 0);
  EXPECT_EQ(scene.frames.count(), 11);
  EXPECT_EQ(scene.frames.variation(FileFrame(0)), "0-0-0-0-0");
  EXPECT_EQ(scene.frames.choice(FileFrame(10), 4), 9);
}

// Sampling must not depend on what is chosen.
TEST(Patterns, LeaveNothingOutWhereAllCanBeMade) {
  Diagnostics diagnostics;
  const std::string text = kChair + axis("seat", {"red", "blue"});
  EXPECT_EQ(parse_text("scene.dsc", text, {{}, {"red"}}, diagnostics).frames.count(), 2);
}

TEST(Formatter, IndentsAxesAndVariations) {
  Diagnostics diagnostics;
  const std::string text =
      "WorldBegin AxisBegin \"a\" VariationBegin \"b\" Show \"c\" Light \"d\" \"float scale\" [ 2 ] VariationEnd "
      "AxisEnd";
  EXPECT_EQ(format_scene({"scene.dsc", text}, diagnostics).value(),
            "WorldBegin\n"
            "AxisBegin \"a\"\n"
            "  VariationBegin \"b\"\n"
            "    Show \"c\"\n"
            "    Light \"d\" \"float scale\" 2\n"
            "  VariationEnd\n"
            "AxisEnd\n");
}

}  // namespace
}  // namespace dspm::test
