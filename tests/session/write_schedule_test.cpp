#include "dspm/session/write_schedule.h"

#include <gtest/gtest.h>

#include <string>

namespace dspm {
namespace write_schedule_test {

TEST(WriteSchedule, IsDueAfterEverySoManyIterations) {
  WriteSchedule third({.seconds = 0, .iterations = 3}), never({});
  std::string due;
  for (int i = 1; i <= 9; ++i) {
    due += third.due(i) ? 'x' : '.';
    EXPECT_FALSE(never.due(i));
  }
  EXPECT_EQ(due, "..x..x..x");
}

TEST(WriteSchedule, EveryIntervalCountsItsOwnIterations) {
  WriteSchedule each({.seconds = 0, .iterations = 1}), third({.seconds = 0, .iterations = 3});
  for (int interval = 0; interval < 3; ++interval) {
    each.begin(0);
    third.begin(0);
    for (int i = 1; i <= 4; ++i) {
      EXPECT_TRUE(each.due(i)) << i;
      EXPECT_EQ(third.due(i), i == 3) << i;
    }
  }
}

TEST(WriteSchedule, GoesOnFromWhatACheckpointHeld) {
  WriteSchedule third({.seconds = 0, .iterations = 3});
  third.begin(5);
  EXPECT_TRUE(third.due(6));
  third.begin(6);
  EXPECT_FALSE(third.due(8));  // of a block of two
  EXPECT_TRUE(third.due(10));
}

}  // namespace write_schedule_test
}  // namespace dspm
