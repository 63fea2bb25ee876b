#include "app/frame_intervals.h"

#include <gtest/gtest.h>

#include <numeric>

namespace dspm {
namespace {

std::vector<std::size_t> lengths(std::size_t frames, int together) {
  std::vector<Frame> all(frames);
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::size_t> result;
  Frame next = 0;
  for (const std::span<const Frame> interval : cut_into_intervals(all, together)) {
    for (const Frame frame : interval) EXPECT_EQ(frame, next++);
    result.push_back(interval.size());
  }
  EXPECT_EQ(next, static_cast<Frame>(frames));
  return result;
}

TEST(FrameIntervals, AreOfEqualLengthAndHoldEveryFrameOnce) {
  using Lengths = std::vector<std::size_t>;
  EXPECT_EQ(lengths(1, 64), Lengths{1});
  EXPECT_EQ(lengths(64, 64), Lengths{64});
  EXPECT_EQ(lengths(65, 64), (Lengths{33, 32}));
  EXPECT_EQ(lengths(128, 64), (Lengths{64, 64}));
  EXPECT_EQ(lengths(129, 64), (Lengths{43, 43, 43}));
  EXPECT_EQ(lengths(3, 1), (Lengths{1, 1, 1}));
}

}  // namespace
}  // namespace dspm
