#include "dspm/base/system/work.h"

#include <gtest/gtest.h>
#include <time.h>

#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

/// Takes that much of this thread's processor time, whatever else runs on the machine.
void work_for(double seconds) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double end = now() + seconds;
  while (now() < end) {}
}

template <class Fn>
Work work_of(const Fn& fn) {
  const Work before = work_done();
  fn();
  return work_done() - before;
}

constexpr double kPiece = 2e-3, kTolerance = 0.15;  // relative; clocks, and the loop's own work

void expect_work(const Work& work, double all, double span) {
  EXPECT_NEAR(work.all, all, kTolerance * all);
  EXPECT_NEAR(work.span, span, kTolerance * span);
}

TEST(Work, IsNotCountedUnlessAskedFor) {
  EXPECT_EQ(work_of([] { work_for(kPiece); }).all, 0);
}

TEST(Work, SpanIsTheLongestChainWithAnyNumberOfThreads) {
  count_work();
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    // 3 alone, then pieces of 1, 2, 3 and 4, then 1 alone.
    expect_work(work_of([] {
                  work_for(3 * kPiece);
                  parallel_for(4, 1, [](std::int64_t i) { work_for(static_cast<double>(i + 1) * kPiece); });
                  work_for(kPiece);
                }),
                14 * kPiece, 8 * kPiece);
  }
}

TEST(Work, LoopsWithinLoopsHaveTheSpanOfTheirPieces) {
  count_work();
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    // Three pieces: 1 alone, and four times 1 side by side. Threads that wait for the inner loop take other pieces.
    expect_work(work_of([] {
                  parallel_for(3, 1, [](std::int64_t) {
                    work_for(kPiece);
                    parallel_for(4, 1, [](std::int64_t) { work_for(kPiece); });
                  });
                }),
                15 * kPiece, 2 * kPiece);
  }
}

TEST(Work, SpeedupFollowsBrent) {
  const Work work{100, 2};
  EXPECT_DOUBLE_EQ(work.seconds(49), 4);
  EXPECT_DOUBLE_EQ(work.speedup(49), 25);
  EXPECT_DOUBLE_EQ(work.serial_share(), 0.02);
  EXPECT_EQ(Work().speedup(64), 1);
}

}  // namespace
}  // namespace dspm
