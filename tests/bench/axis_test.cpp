#include "bench/plots/axis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dspm {
namespace axis_test {

using Values = std::vector<double>;

void expect_ticks(const Axis& axis, const Values& ticks) {
  ASSERT_EQ(axis.ticks.size(), ticks.size());
  for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_NEAR(axis.ticks[i], ticks[i], 1e-9 * ticks.back());
}

TEST(Axis, LinearOnesBeginAtZeroAndHaveRoundTicks) {
  expect_ticks(axis_for(Values{3, 17.2}, Scale::linear), {0, 5, 10, 15, 20});
  expect_ticks(axis_for(Values{0.011, 0.06}, Scale::linear), {0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06});
  expect_ticks(axis_for(Values{-4, 5}, Scale::linear), {-4, -2, 0, 2, 4, 6});
  expect_ticks(axis_for(Values{874}, Scale::linear), {0, 200, 400, 600, 800, 1000});
}

TEST(Axis, LogarithmicOnesHaveOneTwoFiveOrPowers) {
  expect_ticks(axis_for(Values{0.3, 4}, Scale::logarithmic), {0.2, 0.5, 1, 2, 5});
  expect_ticks(axis_for(Values{1, 10}, Scale::logarithmic), {1, 2, 5, 10});
  expect_ticks(axis_for(Values{0.02, 30}, Scale::logarithmic), {0.01, 0.1, 1, 10, 100});
  expect_ticks(axis_for(Values{1, 1000}, Scale::logarithmic), {1, 10, 100, 1000});
}

TEST(Axis, WhatCannotBeShownDoesNotCount) {
  expect_ticks(axis_for(Values{-1, 0, 1, 10, INFINITY}, Scale::logarithmic), {1, 2, 5, 10});
  expect_ticks(axis_for(Values{4, NAN}, Scale::linear), {0, 1, 2, 3, 4});
  EXPECT_FALSE(axis_for(Values{}, Scale::logarithmic).ticks.empty());
  EXPECT_FALSE(axis_for(Values{}, Scale::linear).ticks.empty());
}

TEST(Axis, SpansWhatItWasMadeFor) {
  for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
    for (const double most : {0.0123, 1., 6.02e23, 777.}) {
      const Axis axis = axis_for(Values{most, most / 37}, scale);
      EXPECT_LE(axis.low, most / 37);
      EXPECT_GE(axis.high, most * (1 - 1e-12));
      EXPECT_EQ(axis.position(axis.low), 0);
      EXPECT_NEAR(axis.position(axis.high), 1, 1e-12);
    }
  }
  EXPECT_NEAR(axis_for(Values{1, 100}, Scale::logarithmic).position(10), 0.5, 1e-12);
}

TEST(Axis, TakesGivenTicks) {
  const Axis axis = axis_of(Values{8, 16, 32}, Scale::logarithmic);
  EXPECT_EQ(axis.ticks, (Values{8, 16, 32}));
  EXPECT_NEAR(axis.position(16), 0.5, 1e-12);
}

TEST(TickLabel, IsShort) {
  EXPECT_EQ(tick_label(0), "0");
  EXPECT_EQ(tick_label(0.05), "0.05");
  EXPECT_EQ(tick_label(0.30000000000000004), "0.3");
  EXPECT_EQ(tick_label(200), "200");
  EXPECT_EQ(tick_label(10000), "10,000");
  EXPECT_EQ(tick_label(-250000), "-250,000");
}

}  // namespace axis_test
}  // namespace dspm
