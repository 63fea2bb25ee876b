// Interfaces that contradict each other about the medium between them: the scene is warned of, with both places.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/session/load.h"

namespace dspm::test {
namespace media_check_test {

const std::string kMedia = R"(MakeNamedMedium "fog" "string type" "homogeneous"
MakeNamedMedium "milk" "string type" "homogeneous"
)";

std::vector<Diagnostic> warnings(const std::string& world, const std::string& before = "") {
  static std::vector<std::unique_ptr<LoadedScene>> kept;  // places of messages point into them
  Diagnostics diagnostics;
  kept.push_back(std::make_unique<LoadedScene>(
      "scene.dsc",
      kMedia + before + "LookAt 0 0 -6  0 0 0  0 1 0 Camera \"perspective\"\nWorldBegin LightSource \"infinite\"\n" +
          world,
      Choices(), diagnostics));
  return diagnostics.all();
}

std::string ball(const std::string& inside, const std::string& outside, double radius,
                 const std::string& material = "interface") {
  return fmt::format(
      "AttributeBegin MediumInterface \"{}\" \"{}\" Material \"{}\" Shape \"sphere\" \"float radius\" {} "
      "AttributeEnd\n",
      inside, outside, material, radius);
}

TEST(MediaCheck, FindsNoneWhereNamesAgree) {
  EXPECT_TRUE(warnings(ball("fog", "", 2)).empty());
  EXPECT_TRUE(warnings(ball("fog", "", 2) + ball("milk", "fog", 1)).empty());
  EXPECT_TRUE(warnings(ball("fog", "", 2) + ball("milk", "fog", 1, "dielectric")).empty());
  EXPECT_TRUE(warnings(ball("milk", "fog", 1), "MediumInterface \"\" \"fog\" ").empty());
  // An opaque ball is a wall between them; a surface without an interface says nothing.
  EXPECT_TRUE(warnings(ball("fog", "", 2) + "Material \"diffuse\" Shape \"sphere\" \"float radius\" 1.5\n" +
                       ball("milk", "", 1))
                  .empty());
}

TEST(MediaCheck, WarnsOfShapesThatDisagree) {
  const std::vector<Diagnostic> found = warnings(ball("fog", "", 2) + ball("milk", "", 1));
  ASSERT_EQ(found.size(), 2u);  // from outside and from inside
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_EQ(found[0].where.line, 5);
  EXPECT_EQ(found[0].message,
            "this shape's interface says that \"fog\" lies between it and the shape of line 6, whose interface says no "
            "medium");
  EXPECT_EQ(found[1].where.line, 6);
  EXPECT_EQ(found[1].message,
            "this shape's interface says that no medium lies between it and the shape of line 5, whose interface says "
            "\"fog\"");
}

TEST(MediaCheck, WarnsOfACameraThatDisagrees) {
  const std::vector<Diagnostic> found = warnings(ball("fog", "", 9));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].message,
            "this shape's interface says that \"fog\" lies between it and the camera, which is in no medium");
  EXPECT_TRUE(warnings(ball("fog", "", 9), "MediumInterface \"\" \"fog\" ").empty());
}

}  // namespace media_check_test
}  // namespace dspm::test
