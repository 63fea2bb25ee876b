// --explain says once what holds in all intervals of a render.
#include "dspm/session/explain_intervals.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "dspm/testing/test_scene.h"

namespace dspm {
namespace explain_intervals_test {

TEST(ExplainIntervals, SaysOnceWhatHoldsInAll) {
  test::TestScene test(
      "Frames 6\nWorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n"
      "DynamicBegin \"late\" \"integer frames\" [5 6] Shape \"disk\" DynamicEnd");
  const auto frames = [](int first, int count) {
    FrameList list;
    for (int f = first; f < first + count; ++f) list.emplace_back(f);
    return list;
  };
  const auto explained = [&](const std::vector<FrameList>& intervals) {
    return explain_intervals(test.world(), intervals);
  };
  const std::vector<std::string> all = explained({frames(0, 2), frames(2, 2), frames(4, 2)});
  const auto count = [&](const std::string& begin) {
    return std::count_if(all.begin(), all.end(), [&](const std::string& line) { return line.starts_with(begin); });
  };
  EXPECT_EQ(all.front(), "3 intervals are rendered, one after the other. In each of them:");
  EXPECT_EQ(count("static: "), 1);
  EXPECT_EQ(count("camera: "), 1);
  EXPECT_EQ(count("dynamic \"late\": "), 3);
  EXPECT_EQ(count("2 frames rendered together: 5 to 6."), 1);
  EXPECT_EQ(explained({frames(0, 6)}), test.world().explain(frames(0, 6)));
}

}  // namespace explain_intervals_test
}  // namespace dspm
