// What a file of thousands of frames costs: counts, which no busy machine changes.
#include "dspm/world/objects/timeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/world/objects/frame_ranges.h"
#include "dspm/world/objects/likeness.h"

namespace dspm {
namespace timeline_test {

TEST(Timeline, ThousandsOfStatesAreHardlyCompared) {
  constexpr int kFrames = 10'000, kReturn = 5'000;  // the second half repeats the first one
  int compared = 0;
  const auto line = Timeline<Matrix4>::of(
      kFrames, [](FileFrame f) { return std::optional(Matrix4::translate(f.index() % kReturn * 0.25, 0, 0)); },
      [&](const Matrix4& a, const Matrix4& b) { return ++compared, a == b; },
      [](const Matrix4& m) { return Likeness().add(m).number(); });
  ASSERT_EQ(line.states.size(), static_cast<std::size_t>(kReturn));
  for (FileFrame f(0); f.index() < kFrames; ++f) EXPECT_EQ(line.at(f), f.index() % kReturn);
  EXPECT_LT(compared, kReturn + kReturn / 100);  // each frame of the second half with the one that it repeats
}

TEST(Likeness, IsEqualForWhatIsTheSame) {
  const auto number = [](const auto& value) { return Likeness().add(value).number(); };
  EXPECT_EQ(number(0.0), number(-0.0));
  const auto list = [](std::vector<Param> params) { return ParamList{std::move(params)}; };
  const Param a = param_of(ParamType::number, "a", std::vector{1.f, 0.f}, {}),
              b = param_of(ParamType::text, "b", std::vector<std::string>{"x"}, {}),
              c = param_of(ParamType::number, "a", std::vector{1.f, -0.f}, {});
  EXPECT_EQ(number(list({a, b})), number(list({b, c})));
  EXPECT_NE(number(list({a, b})), number(list({a})));
}

TEST(FrameRanges, AgreeWithAListOfFlags) {
  std::uint32_t random = 1;
  for (int round = 0; round < 50; ++round) {
    constexpr int kFrames = 300;
    std::vector<bool> flags(kFrames);
    FrameRanges ranges;
    for (FileFrame f(0); f.index() < kFrames; ++f) {
      random = random * 1664525 + 1013904223;
      flags[f.slot()] = (random >> 20) % 8 < static_cast<std::uint32_t>(round % 9);
      if (flags[f.slot()]) ranges.add(f);
    }
    std::vector<FileFrame> listed, some;
    ranges.for_each([&](FileFrame f) { listed.push_back(f); });
    for (FileFrame f(0); f.index() < kFrames; ++f) {
      EXPECT_EQ(ranges.contains(f), flags[f.slot()]);
      if (f.index() % 7 == round % 7 && some.size() < kMaxFrames) some.push_back(f);
    }
    EXPECT_EQ(std::count(flags.begin(), flags.end(), true), static_cast<std::ptrdiff_t>(listed.size()));
    for (const FileFrame f : listed) EXPECT_TRUE(flags[f.slot()]);
    const FrameSet among = ranges.among(some);
    for (std::size_t j = 0; j < some.size(); ++j)
      EXPECT_EQ(among.contains(static_cast<Frame>(j)), flags[some[j].slot()]);
    const int first = round * 5, end = first + round % 4;
    EXPECT_EQ(ranges.any(FileFrame(first), FileFrame(end)),
              std::find(flags.begin() + first, flags.begin() + end, true) != flags.begin() + end);
  }
}

TEST(FrameRanges, AThingThatMovesTakesOneInEachPlace) {
  FrameRanges still, passing;
  for (FileFrame f(0); f.index() < 10'000; ++f) still.add(f);
  passing.add(FileFrame(7'000));
  EXPECT_EQ(still.range_count(), 1u);
  EXPECT_EQ(passing.range_count(), 1u);
}

}  // namespace timeline_test
}  // namespace dspm
