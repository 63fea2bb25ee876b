#include "dspm/app/progress.h"

#include <gtest/gtest.h>

#include <string>

namespace dspm {
namespace {

/// Tests do not run on a terminal: lines come now and then, never a bar, and nothing at once.
TEST(Progress, IsSilentWhereNothingIsDue) {
  testing::internal::CaptureStderr();
  {
    Progress progress({.iterations = 10, .time_limit = 0, .intervals = 1}, false);
    for (int i = 1; i <= 10; ++i) progress.step(0, i);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

std::string first_bar(const Progress::Extent& extent, int interval, int iterations) {
  testing::internal::CaptureStderr();
  {
    Progress progress(extent, false, true);
    progress.step(interval, iterations);
  }
  const std::string text = testing::internal::GetCapturedStderr();
  return text.substr(1, text.find(',') - 1);  // after \r, before the time
}

TEST(Progress, FillsItsBar) {
  const std::string half(16, '='), quarter(8, '=');
  EXPECT_EQ(first_bar({.iterations = 10}, 0, 5), "[" + half + std::string(16, ' ') + "] iteration 5/10");
  EXPECT_EQ(first_bar({.iterations = 10}, 0, 10), "[" + half + half + "] iteration 10/10");
  EXPECT_EQ(first_bar({.iterations = 8, .intervals = 2}, 1, 4),
            "[" + half + quarter + std::string(8, ' ') + "] iteration 4/8 of frame interval 2/2");
}

TEST(Progress, HasNoBarWithoutAnEnd) { EXPECT_EQ(first_bar({.iterations = 0}, 0, 5), "iteration 5"); }

}  // namespace
}  // namespace dspm
