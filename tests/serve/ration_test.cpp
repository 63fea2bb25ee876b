#include "dspm/looking/serve/ration.h"

#include <gtest/gtest.h>

namespace dspm {
namespace ration_test {

using namespace std::chrono_literals;
const Ration::Clock::time_point kStart{1h};

TEST(Ration, IsDueOnceWhatWasTakenIsItsShare) {
  Ration hundredth(0.01);
  EXPECT_TRUE(hundredth.is_due(kStart));
  hundredth.took(kStart, kStart + 1s);
  EXPECT_FALSE(hundredth.is_due(kStart + 99s));
  EXPECT_TRUE(hundredth.is_due(kStart + 100s));
  hundredth.took(kStart + 200s, kStart + 202s);  // what was not taken meanwhile is not made up for
  EXPECT_FALSE(hundredth.is_due(kStart + 399s));
  EXPECT_TRUE(hundredth.is_due(kStart + 400s));
}

TEST(Ration, WhatWasTakenTooEarlyIsSavedLater) {
  Ration hundredth(0.01);
  hundredth.took(kStart, kStart + 1s);
  hundredth.took(kStart + 2s, kStart + 3s);
  EXPECT_FALSE(hundredth.is_due(kStart + 199s));
  EXPECT_TRUE(hundredth.is_due(kStart + 200s));
  hundredth.reset();
  EXPECT_TRUE(hundredth.is_due(kStart + 3s));
}

}  // namespace ration_test
}  // namespace dspm
