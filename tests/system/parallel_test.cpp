#include "dspm/base/system/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace dspm {
namespace {

TEST(Parallel, VisitsEveryIndexOnce) {
  for (const std::int64_t count : {0, 1, 2, 99, 100, 101, 12345}) {
    std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
    parallel_for(count, 7, [&](std::int64_t i) { ++visits[static_cast<std::size_t>(i)]; });
    EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& v) { return v == 1; })) << count;
  }
}

std::set<std::pair<std::int64_t, std::int64_t>> chunks_with(int threads, std::int64_t count, std::int64_t grain) {
  const ThreadLimit limit(threads);
  std::mutex mutex;
  std::set<std::pair<std::int64_t, std::int64_t>> chunks;
  parallel_chunks(count, grain, [&](std::int64_t begin, std::int64_t end) {
    const std::lock_guard lock(mutex);
    chunks.emplace(begin, end);
  });
  return chunks;
}

TEST(Parallel, ChunksDependOnCountAndGrainAlone) {
  const auto chunks = chunks_with(1, 1000, 64);
  ASSERT_EQ(static_cast<std::int64_t>(chunks.size()), chunk_count(1000, 64));
  std::int64_t next = 0;
  for (const auto& [begin, end] : chunks) {
    EXPECT_EQ(begin, next);
    EXPECT_EQ(end, std::min<std::int64_t>(begin + 64, 1000));
    next = end;
  }
  EXPECT_EQ(next, 1000);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(chunks_with(threads, 1000, 64), chunks);
}

/// Sums of floats depend on their order; sums per chunk, added up in the order of chunks, must not depend on threads.
float chunked_sum(int threads) {
  const ThreadLimit limit(threads);
  constexpr std::int64_t kCount = 1'000'000, kGrain = 1000;
  std::vector<float> sums(static_cast<std::size_t>(chunk_count(kCount, kGrain)));
  parallel_chunks(kCount, kGrain, [&](std::int64_t begin, std::int64_t end) {
    float sum = 0;
    for (std::int64_t i = begin; i < end; ++i) sum += 1.f / static_cast<float>(i + 1);
    sums[static_cast<std::size_t>(begin / kGrain)] = sum;
  });
  float total = 0;
  for (const float sum : sums) total += sum;
  return total;
}

TEST(Parallel, TheSameBitsOnOneTwoAndEightThreads) {
  EXPECT_EQ(chunked_sum(1), chunked_sum(2));
  EXPECT_EQ(chunked_sum(1), chunked_sum(8));
}

TEST(Parallel, TheLimitHolds) {
  EXPECT_EQ(thread_count(), static_cast<int>(std::thread::hardware_concurrency()));
  const ThreadLimit outer(4);
  EXPECT_EQ(thread_count(), 4);
  {
    const ThreadLimit inner(1);
    EXPECT_EQ(thread_count(), 1);
    const std::thread::id main_thread = std::this_thread::get_id();
    std::atomic<int> elsewhere = 0;
    parallel_for(1000, 1, [&](std::int64_t) { elsewhere += std::this_thread::get_id() != main_thread; });
    EXPECT_EQ(elsewhere, 0);
  }
  EXPECT_EQ(thread_count(), 4);
}

/// Two bodies that wait for one another only end when two threads run them.
TEST(Parallel, ThreadsRunAtTheSameTime) {
  const ThreadLimit limit(2);
  std::atomic<int> arrived = 0;
  parallel_for(2, 1, [&](std::int64_t) {
    ++arrived;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (arrived < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

/// Whose loops are not done yet: a scene that is read while another one is rendered.
TEST(Parallel, ASecondThreadsLoopDoesNotWaitForTheFirstOnes) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    std::atomic<bool> has_begun = false, is_done = false;
    std::thread second([&] {
      while (!has_begun) std::this_thread::yield();
      parallel_for(100, 1, [](std::int64_t) {});
      is_done = true;
    });
    parallel_for(8, 1, [&](std::int64_t) {
      has_begun = true;
      const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (!is_done && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    });
    EXPECT_TRUE(is_done);
    second.join();
  }
}

TEST(Parallel, ExceptionsComeOutAndTheNextLoopWorks) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const auto failing = [](std::int64_t i) {
      if (i == 500) throw std::runtime_error("number 500");
    };
    EXPECT_THROW(parallel_for(1000, 10, failing), std::runtime_error);
    std::atomic<int> visited = 0;
    parallel_for(1000, 10, [&](std::int64_t) { ++visited; });
    EXPECT_EQ(visited, 1000);
  }
}

TEST(Parallel, LoopsMayBeNested) {
  const ThreadLimit limit(2);
  std::atomic<int> visited = 0;
  parallel_for(20, 1, [&](std::int64_t) { parallel_for(50, 3, [&](std::int64_t) { ++visited; }); });
  EXPECT_EQ(visited, 1000);
}

}  // namespace
}  // namespace dspm
