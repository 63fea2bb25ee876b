#include "dspm/base/system/readable.h"

#include <gtest/gtest.h>

namespace dspm {
namespace {

TEST(Readable, TimesAreShort) {
  EXPECT_EQ(readable_time(0.04), "0.0s");
  EXPECT_EQ(readable_time(12.34), "12.3s");
  EXPECT_EQ(readable_time(59.4), "59.4s");
  EXPECT_EQ(readable_time(59.6), "1m00s");
  EXPECT_EQ(readable_time(192), "3m12s");
  EXPECT_EQ(readable_time(3599.7), "1h00m");
  EXPECT_EQ(readable_time(7500), "2h05m");
}

TEST(Readable, BytesHaveUnits) {
  EXPECT_EQ(readable_bytes(999), "999 B");
  EXPECT_EQ(readable_bytes(12'345), "12.3 KB");
  EXPECT_EQ(readable_bytes(678'200'000), "678.2 MB");
}

TEST(Readable, CountsHaveGroupsAndPlurals) {
  EXPECT_EQ(counted(1, "frame"), "1 frame");
  EXPECT_EQ(counted(0, "frame"), "0 frames");
  EXPECT_EQ(counted(25, "frame"), "25 frames");
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(12345678), "12,345,678");
}

}  // namespace
}  // namespace dspm
