#include "dspm/app/progress.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace dspm
