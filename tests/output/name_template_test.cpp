#include "dspm/output/name_template.h"

#include <gtest/gtest.h>

#include "dspm/base/params/errors.h"

namespace dspm {
namespace name_template_test {

std::string filled(std::string_view pattern) {
  return filled_in(pattern, {{"variation", "oak-red"}, {"legs", "oak"}, {"the seat", "red"}}, 7);
}

TEST(NameTemplate, HasNamesForItsParts) {
  EXPECT_EQ(filled("{legs}_{the seat}_{frame}.exr"), "oak_red_0007.exr");
  EXPECT_EQ(filled("{variation}/{frame:2}.png"), "oak-red/07.png");
  EXPECT_EQ(filled("{frame:1}{frame:9}"), "7000000007");
  EXPECT_EQ(filled("a{{legs}}{legs}}}.exr"), "a{legs}oak}.exr");
  EXPECT_EQ(filled("plain.exr"), "plain.exr");
  EXPECT_TRUE(is_template("a{b}"));
  EXPECT_FALSE(is_template("a.exr"));
}

std::string refusal(std::string_view pattern) {
  try {
    return filled(pattern);
  } catch (const UsageError& error) {
    return error.what();
  }
}

TEST(NameTemplate, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(
      refusal("{leg}.exr"),
      "the images' name {leg}.exr: {leg} is not known; did you mean \"legs\"? there are variation, legs, the seat, "
      "frame");
  EXPECT_EQ(
      refusal("{frame:0}"),
      "the images' name {frame:0}: {frame:0} is not known; did you mean \"frame\"? there are variation, legs, the "
      "seat, frame");
  EXPECT_EQ(refusal("a{legs"), "the images' name a{legs: a } is missing; {{ stands for the brace itself");
}

}  // namespace name_template_test
}  // namespace dspm
