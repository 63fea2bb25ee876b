// Bodies that overlap although nothing says which of them is there: the scene is warned of, with the place.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/session/load.h"

namespace dspm::test {
namespace overlaps_test {

std::vector<Diagnostic> messages_of(const std::string& contents) {
  static std::vector<std::unique_ptr<LoadedScene>> kept;  // places of messages point into them
  Diagnostics diagnostics;
  kept.push_back(std::make_unique<LoadedScene>("scene.dsc", contents, Choices(), diagnostics));
  return diagnostics.all();
}
std::vector<std::string> warnings(const std::string& contents, const std::string& before = "") {
  std::vector<std::string> texts;
  for (const Diagnostic& each : messages_of(before + "WorldBegin LightSource \"infinite\"\n" + contents))
    texts.push_back(each.message);
  return texts;
}
std::string ball(double x, double radius, const std::string& more = "") {
  return fmt::format("AttributeBegin Translate {} 0 0 Shape \"sphere\" \"float radius\" {} {} AttributeEnd\n", x,
                     radius, more);
}
std::string glass(const std::string& name, const std::string& more = "") {
  return "MakeNamedMaterial \"" + name + "\" \"string type\" \"dielectric\" " + more + " NamedMaterial \"" + name +
         "\"\n";
}

TEST(Overlaps, AreWarnedOfWithTheirPlace) {
  const std::string scene = glass("glass") + ball(0, 1) + glass("liquid") + ball(1.5, 1);
  const std::vector<std::string> texts = warnings(scene);
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_NE(
      texts[0].find("shape \"sphere\" with material \"liquid\" overlaps shape \"sphere\" with material \"glass\""),
      std::string::npos)
      << texts[0];
  EXPECT_NE(texts[0].find("(scene.dsc:3) near 0.7"), std::string::npos) << texts[0];
  EXPECT_NE(texts[0].find("both have priority 0"), std::string::npos) << texts[0];
  const Diagnostic warning = messages_of("WorldBegin LightSource \"infinite\"\n" + scene).front();
  EXPECT_EQ(warning.where.line, 5);
  EXPECT_NE(warning.hint.find("integer priority"), std::string::npos);
}

TEST(Overlaps, AreNoFaultIfPrioritiesDecide) {
  EXPECT_EQ(warnings(glass("glass", "\"integer priority\" 1") + ball(0, 1) + glass("liquid") + ball(1.5, 1)),
            std::vector<std::string>{});
  EXPECT_EQ(warnings(glass("glass", "\"integer priority\" 1") + ball(0, 1) + glass("liquid", "\"integer priority\" 1") +
                     ball(1.5, 1))
                .size(),
            1u);
}

// Within one another, apart, touching, and boundaries of glass and liquid with materials of their own.
TEST(Overlaps, AreNotSeenWhereThereAreNone) {
  EXPECT_EQ(warnings(glass("glass") + ball(0, 1) + glass("bubble") + ball(.2, .5)), std::vector<std::string>{});
  EXPECT_EQ(warnings(glass("glass") + ball(0, 1) + glass("other") + ball(1.99, .5)), std::vector<std::string>{});
  EXPECT_EQ(warnings(glass("glass") + ball(0, 1) + "ReverseOrientation\n" + ball(0, .7)), std::vector<std::string>{});
  const std::string boundaries = glass("glass") + R"(Shape "cylinder" "float radius" 1 "float zmin" -1
Shape "disk" "float height" 1 "float innerradius" .8 "float radius" 1
AttributeBegin ReverseOrientation Shape "disk" "float height" -1 "float radius" 1
Shape "cylinder" "float radius" .8 "float zmin" .2 AttributeEnd
)" + glass("liquid in glass") + R"(Shape "cylinder" "float radius" .8 "float zmin" -.8 "float zmax" .2
AttributeBegin ReverseOrientation Shape "disk" "float height" -.8 "float radius" .8 AttributeEnd
)" + glass("liquid") + R"(Shape "disk" "float height" .2 "float radius" .8
)";
  EXPECT_EQ(warnings(boundaries), std::vector<std::string>{});
}

TEST(Overlaps, OfOneMaterialAreSeenAsWell) {
  EXPECT_EQ(warnings(glass("ice") + ball(0, 1) + ball(1.8, 1)).size(), 1u);
  EXPECT_EQ(warnings("ObjectBegin \"cube\"\n" + glass("ice") + ball(0, 1) +
                     "ObjectEnd\nObjectInstance \"cube\" Translate 1.8 0 0 ObjectInstance \"cube\"\n")
                .size(),
            1u);
}

TEST(Overlaps, OfSomeFramesNameOne) {
  const std::vector<std::string> texts =
      warnings(glass("glass") + ball(0, 1) + glass("liquid") +
                   "DynamicBegin \"liquid\" Keyframe 1 Translate 4 0 0 Keyframe 4 Translate 1 0 0 KeyframeEnd\n" +
                   ball(0, .9) + "DynamicEnd\n",
               "Frames 4\n");
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_NE(texts[0].find("in frame 4"), std::string::npos) << texts[0];
}

TEST(Overlaps, OfSomeVariationsNameOne) {
  const std::string balls =
      glass("glass") + ball(0, 1) + glass("liquid") + "DynamicBegin \"drink\"\n" + ball(1.5, 1) + "DynamicEnd\n";
  const std::string axis =
      "VariationBegin \"empty\" Hide \"drink\" VariationEnd VariationBegin \"full\" VariationEnd\n";
  for (const auto& [frames, words] :
       {std::pair{"", "in variation \"full\""}, std::pair{"Frames 2\n", "in frame 1 of variation \"full\""}}) {
    const std::vector<std::string> texts = warnings(balls + axis, frames);
    ASSERT_EQ(texts.size(), 1u);
    EXPECT_NE(texts[0].find(words), std::string::npos) << texts[0];
  }
}

TEST(Overlaps, MustNotHideWhatScattersInside) {
  const std::string milk = "Material \"subsurface\" \"string name\" \"Wholemilk\" ";
  const auto overlap = [&](int priority) {
    return warnings(glass("glass", "\"integer priority\" 1") + ball(0, 1) + milk +
                    fmt::format("\"integer priority\" {}\n", priority) + ball(1.5, 1));
  };
  EXPECT_EQ(overlap(2), std::vector<std::string>{});
  ASSERT_EQ(overlap(0).size(), 1u);
  EXPECT_NE(overlap(0)[0].find("scatters light inside"), std::string::npos) << overlap(0)[0];
}

TEST(Overlaps, PriorityOfWhatBoundsNoBodyIsWarnedOf) {
  const std::vector<std::string> texts = warnings("Material \"diffuse\" \"integer priority\" 1\n" + ball(0, 1));
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_NE(texts[0].find("bounds no body"), std::string::npos) << texts[0];
}

}  // namespace overlaps_test
}  // namespace dspm::test
