// Strands that follow one another become one shape.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "dspm/base/params/errors.h"
#include "dspm/session/load.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace curves_test {

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

/// Strands of a run are made without a directive for each; an empty block after each ends every run.
TEST(Strands, OfARunAreThoseMadeOneByOne) {
  std::mt19937 random(3);
  const auto number = [&] { return fmt::format(" {}", static_cast<int>(random() % 2001) / 1000.0 - 1); };
  const auto strand = [&](int points) {
    std::string list;
    for (int i = 0; i < 3 * points; ++i) list += number();
    return "Shape \"curve\" \"point3 P\" [" + list + " ] \"float width0\" [ 0.01 ] \"float width1\" [ 0.02 ]";
  };
  std::string in_runs, apart;
  for (int i = 0; i < 1500; ++i) {
    std::string line = strand(i % 7 == 0 ? 7 : 4);
    if (i % 400 == 17) line += " \"string type\" \"cylinder\"";
    if (i % 400 == 301) line += " \"float alpha\" 0.5";
    if (i == 1000) line += " Material \"hair\"";
    in_runs += line + "\n", apart += line + " AttributeBegin AttributeEnd\n";
  }
  const std::string head = "Frames 2 WorldBegin LightSource \"point\" Translate 1 0 0\n";
  const TestScene a(head + in_runs), b(head + apart);
  const auto left = a.scene(a.all_frames()), right = b.scene(b.all_frames());
  ASSERT_EQ(left->shapes.size(), right->shapes.size());
  for (std::size_t s = 0; s < left->shapes.size(); ++s) {
    const PlacedShape &p = left->shapes[s], &q = right->shapes[s];
    ASSERT_EQ(p.shape->primitive_count(), q.shape->primitive_count());
    EXPECT_EQ(p.material, q.material);
    EXPECT_EQ(p.object, q.object);
    for (int i = 0; i < p.shape->primitive_count(); ++i) {
      ASSERT_EQ(p.shape->bounds(i).low, q.shape->bounds(i).low);
      ASSERT_EQ(p.shape->bounds(i).high, q.shape->bounds(i).high);
      ASSERT_EQ(p.shape->surface_point(i, {0.3f, 0.4f}).p, q.shape->surface_point(i, {0.3f, 0.4f}).p);
    }
  }
}

/// What is wrong with one strand of many is said at its place, and the others are what they would be without it.
TEST(Strands, OfARunHaveMessagesOfTheirOwn) {
  std::string scene = "WorldBegin LightSource \"point\"\n";
  for (int i = 0; i < 1000; ++i)
    scene += fmt::format("Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0{}] \"float width\" {}\n",
                         i == 700 ? "" : " 3 0 0", i == 300 ? -1 : 1);
  Diagnostics diagnostics;
  try {
    const LoadedScene loaded("scene.dsc", scene, {}, diagnostics);
  } catch (const SceneError&) {}
  ASSERT_EQ(diagnostics.all().size(), 2u);
  EXPECT_EQ(diagnostics.all()[0].message, "\"width\" must not be negative");
  EXPECT_EQ(diagnostics.all()[0].where.line, 302);
  EXPECT_EQ(diagnostics.all()[1].message, "at least 4 control points are needed, but \"P\" has 3");
  EXPECT_EQ(diagnostics.all()[1].where.line, 702);
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

}  // namespace curves_test
}  // namespace dspm
