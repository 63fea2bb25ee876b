// The watch reports a step that does not end after `patience`, and not before.
#include "dspm/app/run/watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "dspm/base/system/activity.h"

namespace dspm {
namespace {

/// The reports on a step of that length, after one that ended at once.
std::string reports(double patience, std::chrono::milliseconds length) {
  testing::internal::CaptureStderr();
  {
    Watch watch(patience);
    watch.begin("iteration 3", "");
    watch.begin("iteration 4", "integrator \"slow\"");
    std::this_thread::sleep_for(length);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Watch, SaysNothingOfStepsThatEndInTime) { EXPECT_EQ(reports(1000, std::chrono::milliseconds(100)), ""); }

TEST(Watch, SaysWhoHasNotEndedAndWaitsTwiceAsLongEachTime) {
  const std::string text = reports(0.02, std::chrono::milliseconds(300));
  EXPECT_TRUE(text.starts_with("dspm: iteration 4 has not ended after 0.")) << text;
  EXPECT_NE(text.find("s, at work: integrator \"slow\"\n"), std::string::npos) << text;
  // After 0.02, 0.04, 0.08, 0.16 s; two more where the machine is slow and the step takes up to 1.28 s.
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 6) << text;
}

TEST(Watch, SaysThatAnIterationLearns) {
  const Activity activity("learning where photons start");
  const std::string text = reports(0.02, std::chrono::milliseconds(100));
  EXPECT_TRUE(text.starts_with("dspm: learning where photons start has not ended after 0.")) << text;
}

}  // namespace
}  // namespace dspm
