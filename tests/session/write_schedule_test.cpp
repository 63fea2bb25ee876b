#include "dspm/session/write_schedule.h"

#include <gtest/gtest.h>

#include <string>

namespace dspm {
namespace {

TEST(WriteSchedule, IsDueAfterEverySoManyIterations) {
  WriteSchedule third({.seconds = 0, .iterations = 3}), never({});
  std::string due;
  for (int i = 1; i <= 9; ++i) {
    due += third.due(i) ? 'x' : '.';
    EXPECT_FALSE(never.due(i));
  }
  EXPECT_EQ(due, "..x..x..x");
}

}  // namespace
}  // namespace dspm
