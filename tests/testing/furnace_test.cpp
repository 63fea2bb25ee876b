// The furnaces tell what an integrator leaves out.
#include "dspm/testing/furnace.h"

#include <gtest/gtest.h>

namespace dspm::test {
namespace furnace_test {

TEST(FurnaceChecks, LongPathsAreRight) {
  const Verdict verdict = check_furnace(R"("path" "integer maxdepth" 40)", 4, {0.01, 0.001});
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

// 0.8^8 of the light is left out: 17%.
TEST(FurnaceChecks, ShortPathsAreNot) {
  const Verdict verdict = check_furnace(R"("path" "integer maxdepth" 8)", 4);
  EXPECT_FALSE(verdict.passed);
  EXPECT_NE(verdict.message.find("albedo 0.8"), std::string::npos) << verdict.message;
}

// Paths that end at once see the lamp only.
TEST(FurnaceChecks, NoPathsShowNoAlbedo) {
  EXPECT_TRUE(check_open_furnace("\"diffuse\"", "\"path\"", 4).passed);
  EXPECT_FALSE(check_open_furnace("\"diffuse\"", "\"path\" \"integer maxdepth\" 0", 4).passed);
}

}  // namespace furnace_test
}  // namespace dspm::test
