#include "dspm/app/progress.h"

#include <gtest/gtest.h>

namespace dspm {
namespace {

TEST(ReadableTime, IsShort) {
  EXPECT_EQ(readable_time(0.04), "0.0s");
  EXPECT_EQ(readable_time(12.34), "12.3s");
  EXPECT_EQ(readable_time(59.4), "59.4s");
  EXPECT_EQ(readable_time(59.6), "1m00s");
  EXPECT_EQ(readable_time(192), "3m12s");
  EXPECT_EQ(readable_time(3599.7), "1h00m");
  EXPECT_EQ(readable_time(7500), "2h05m");
}

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
