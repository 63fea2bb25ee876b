// Strands that follow one another become one shape.
#include <gtest/gtest.h>

#include "dspm/params/errors.h"
#include "dspm/session/load.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace {

using test::TestScene;

const std::string kStrand =
    R"(Shape "curve" "float width" .1 "integer splitdepth" 0 "point3 P" [0 0 0 1 0 0 2 0 0 3 0 0]
)";

std::vector<int> primitives(const std::string& contents) {
  const TestScene test("Frames 2 WorldBegin LightSource \"point\"\n" + contents);
  std::vector<int> counts;
  const auto scene = test.scene(test.all_frames());
  for (const PlacedShape& shape : scene->shapes) counts.push_back(shape.shape->primitive_count());
  return counts;
}

using Counts = std::vector<int>;

TEST(Strands, AlikeOnesAreOneShape) {
  EXPECT_EQ(primitives(kStrand + kStrand + kStrand), Counts{3});
  EXPECT_EQ(primitives("AttributeBegin Translate 1 0 0\n" + kStrand + kStrand + "AttributeEnd\n" + kStrand),
            (Counts{2, 1}));
  EXPECT_EQ(primitives("AttributeBegin Translate 1 0 0\n" + kStrand + "AttributeEnd AttributeBegin Translate 1 0 0\n" +
                       kStrand + "AttributeEnd"),
            Counts{2});
  EXPECT_EQ(primitives(kStrand + "Material \"hair\"\n" + kStrand), (Counts{1, 1}));
  EXPECT_EQ(primitives(kStrand + "Shape \"sphere\"\n" + kStrand), (Counts{1, 1, 1}));
  EXPECT_EQ(primitives(kStrand + "Shape \"curve\" \"string type\" \"cylinder\" \"integer splitdepth\" 0 \"point3 P\" "
                                 "[0 0 0 1 0 0 2 0 0 3 0 0]"),
            (Counts{1, 1}));
  EXPECT_EQ(
      primitives(
          kStrand +
          "Shape \"curve\" \"string name\" \"lock\" \"integer splitdepth\" 0 \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]"),
      (Counts{1, 1}));
}

TEST(Strands, MoveTogether) {
  EXPECT_EQ(primitives("DynamicBegin \"head\" Keyframe 1 Translate 0 0 0 Keyframe 2 Translate 1 0 0 KeyframeEnd\n" +
                       kStrand + kStrand + "DynamicEnd"),
            (Counts{2, 2}));
  EXPECT_EQ(primitives("ObjectBegin \"lock\"\n" + kStrand + kStrand +
                       "ObjectEnd ObjectInstance \"lock\" Translate 0 1 0 ObjectInstance \"lock\""),
            (Counts{2, 2}));
}

TEST(Strands, ShowNoRelief) {
  const std::string scene =
      "WorldBegin LightSource \"point\" Texture \"waves\" \"float\" \"fbm\"\n"
      "Material \"diffuse\" \"texture displacement\" \"waves\"\n";
  Diagnostics diagnostics;
  const LoadedScene loaded("scene.dsc", scene + kStrand + "Shape \"sphere\"\n", {}, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].message, "shape \"curve\" does not show the relief of material \"diffuse\"");
}

TEST(Strands, DoNotShine) {
  try {
    TestScene("WorldBegin AreaLightSource \"diffuse\"\n" + kStrand);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("an area light on shape \"curve\" is not supported"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace dspm
