#include "dspm/base/math/frame_lanes.h"

#include <gtest/gtest.h>

namespace dspm {
namespace {

TEST(FrameLanes, GroupsCoverAllFramesOnce) {
  const FrameSet frames((std::uint64_t{1} << 63) | 0x0f01);
  std::uint64_t covered = 0;
  for_each_group(frames, [&](int group, __m128 lanes) {
    covered |= static_cast<std::uint64_t>(_mm_movemask_ps(lanes)) << 4 * group;
  });
  EXPECT_EQ(covered, frames.bits());
}

}  // namespace
}  // namespace dspm
