// A frame of the file, a frame of the interval and a moment are not taken for one another.
#include "dspm/base/math/frames.h"

#include <gtest/gtest.h>

#include <set>
#include <type_traits>

#include "dspm/base/math/moments.h"

namespace dspm {
namespace {

template <class A, class B>
concept Mixes = std::is_convertible_v<A, B> || std::is_convertible_v<B, A> || std::is_assignable_v<A&, B> ||
    std::is_assignable_v<B&, A> || requires(A a, B b) {
  a == b;
} || requires(A a, B b) {
  a < b;
};

static_assert(Mixes<Frame, double>);
static_assert(!Mixes<Frame, FileFrame> && !Mixes<Frame, Moment> && !Mixes<FileFrame, Moment>);
static_assert(!Mixes<double, FileFrame> && !Mixes<double, Moment>);
static_assert(!std::is_constructible_v<FileFrame, Moment> && !std::is_constructible_v<Moment, FileFrame>);
static_assert(!std::is_constructible_v<Frame, FileFrame> && !std::is_constructible_v<Frame, Moment>);
static_assert(!std::is_invocable_v<decltype(&FrameSet::single), FileFrame>);
static_assert(sizeof(FileFrame) == sizeof(int) && std::is_trivially_copyable_v<FileFrame>,
              "checkpoints hold its bytes");

TEST(FileFrame, IsOrdered) {
  const std::set<FileFrame> frames{FileFrame(7), FileFrame(), FileFrame(7), FileFrame(2)};
  EXPECT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames.begin()->index(), 0);
  EXPECT_EQ(frames.rbegin()->slot(), 7u);
  FileFrame next(6);
  EXPECT_EQ(++next, FileFrame(7));
}

TEST(Moment, IsCountedFromOneInTexts) {
  EXPECT_EQ(Moment(), Moment::numbered(1));
  EXPECT_EQ(Moment::numbered(25).frames(), 24);
  EXPECT_EQ(Moment(24).number(), 25);
  EXPECT_EQ(Moment(24.75).number(), 25);
  EXPECT_EQ(Moment(-0.5).number(), 0);
}

TEST(Moment, LiesBetweenOthers) {
  EXPECT_LT(Moment(1), Moment(1.5));
  EXPECT_EQ(fraction(Moment(1), Moment(3), Moment(1.5)), 0.25);
  const MomentInterval interval{Moment(2), Moment(4)};
  EXPECT_FALSE(interval.contains(Moment(1.75)));
  EXPECT_TRUE(interval.contains(Moment(2)));
  EXPECT_TRUE(interval.contains(Moment(3.75)));
  EXPECT_FALSE(interval.contains(Moment(4)));
}

}  // namespace
}  // namespace dspm
