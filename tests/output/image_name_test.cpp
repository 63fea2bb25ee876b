#include "dspm/output/image_name.h"

#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"

namespace dspm {
namespace image_name_test {

TEST(ImageName, FramesAreNumberedFromOne) {
  EXPECT_EQ(image_name("water.exr", Moment(0)), "water.0001.exr");
  EXPECT_EQ(image_name("out/water.exr", Moment(24)), "out/water.0025.exr");
  EXPECT_EQ(image_name("water.exr", Moment(12344)), "water.12345.exr");
}

TEST(ImageName, AStillHasNoNumber) {
  EXPECT_EQ(image_name("out/water.exr", std::nullopt), "out/water.exr");
  EXPECT_EQ(image_name("water", std::nullopt), "water");
}

TEST(ImageName, ThePatternSaysWhereTheNumberGoes) {
  EXPECT_EQ(image_name("shot-%04d.final.exr", Moment(6)), "shot-0007.final.exr");
  EXPECT_EQ(image_name("shot%d.exr", Moment(6)), "shot7.exr");
  EXPECT_EQ(image_name("%2d.exr", Moment(6)), "07.exr");
  EXPECT_EQ(image_name("a.####.exr", Moment(6)), "a.0007.exr");
  EXPECT_EQ(image_name("a_##.exr", Moment(122)), "a_123.exr");
  EXPECT_EQ(image_name("a.###.exr", std::nullopt), "a.001.exr");
}

TEST(ImageName, OtherMarksAreKept) {
  EXPECT_EQ(image_name("50%.exr", Moment(0)), "50%.0001.exr");
  EXPECT_EQ(image_name("50%-%03d.exr", Moment(0)), "50%-001.exr");
  EXPECT_EQ(image_name("no#1.exr", Moment(0)), "no#1.0001.exr");
  EXPECT_EQ(image_name("%999d.exr", Moment(0)), "%999d.0001.exr") << "no name has that many digits";
  EXPECT_EQ(image_name("d####/a.exr", Moment(0)), "d####/a.0001.exr") << "directories are not numbered";
}

TEST(ImageName, LabelsComeBeforeTheNumber) {
  EXPECT_EQ(image_name("chair.exr", std::nullopt, "oak-red"), "chair.oak-red.exr");
  EXPECT_EQ(image_name("chair.exr", Moment(0), "oak-red"), "chair.oak-red.0001.exr");
  EXPECT_EQ(image_name("chair.####.exr", Moment(0), "oak-red"), "chair.oak-red.0001.exr");
}

}  // namespace image_name_test
}  // namespace dspm
