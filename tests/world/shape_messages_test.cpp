// Shapes are made by many threads; what is said about them comes in the order of the scene.
#include <gtest/gtest.h>

#include "dspm/session/load.h"

namespace dspm::test {
namespace shape_messages_test {

TEST(ShapeMessages, ComeInTheOrderOfTheScene) {
  std::string scene = "WorldBegin LightSource \"infinite\"\n";
  constexpr int kShapes = 5000;  // more than are made at a time
  for (int i = 0; i < kShapes; ++i) scene += "Shape \"sphere\" \"float radius\" -1\n";
  Diagnostics diagnostics;
  EXPECT_THROW(LoadedScene("scene.dsc", scene, {}, diagnostics), SceneError);
  ASSERT_EQ(diagnostics.all().size(), static_cast<std::size_t>(kShapes));
  for (int i = 0; i < kShapes; ++i) ASSERT_EQ(diagnostics.all()[static_cast<std::size_t>(i)].where.line, i + 2);
}

TEST(ShapeMessages, EndWithTheFirstStateThatIsWrong) {
  Diagnostics diagnostics;
  EXPECT_THROW(LoadedScene("scene.dsc",
                           "Frames 40 WorldBegin LightSource \"infinite\"\n"
                           "DynamicBegin \"ball\" Shape \"sphere\" \"float radius@1\" 1 \"float radius@20\" -1 "
                           "\"float radius@40\" -9 DynamicEnd",
                           {}, diagnostics),
               SceneError);
  EXPECT_EQ(diagnostics.error_count(), 1);
}

}  // namespace shape_messages_test
}  // namespace dspm::test
