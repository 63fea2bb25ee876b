// Loops over many threads; the only place that knows TBB (see parallel.cpp). Which thread does what, and when, is
// unspecified: a body may only write to slots of its own. The chunks depend on count and grain alone, so results per
// chunk are the same with any number of threads.
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>

namespace dspm {

namespace detail {
using ChunkBody = void (*)(const void* context, std::int64_t begin, std::int64_t end);
void run_chunks(std::int64_t count, std::int64_t grain, ChunkBody body, const void* context);
}  // namespace detail

/// Calls body(begin, end) for [0, grain), [grain, 2 grain), ... up to count, in parallel. If a body throws, chunks that
/// have not begun may be skipped, and one of the exceptions is rethrown here. May throw Cancelled (see
/// base/system/cancellation.h).
template <class Body>
void parallel_chunks(std::int64_t count, std::int64_t grain, const Body& body) {
  detail::run_chunks(
      count, grain,
      [](const void* context, std::int64_t begin, std::int64_t end) {
        (*static_cast<const Body*>(context))(begin, end);
      },
      &body);
}

/// Calls body(index) for every index in [0, count), `grain` consecutive ones at a time on one thread.
template <class Body>
void parallel_for(std::int64_t count, std::int64_t grain, const Body& body) {
  parallel_chunks(count, grain, [&body](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) body(i);
  });
}

/// The number of chunks of parallel_chunks: chunk c begins at c * grain.
constexpr std::int64_t chunk_count(std::int64_t count, std::int64_t grain) {
  return count <= 0 ? 0 : (count - 1) / grain + 1;
}

/// The number of threads that a loop may use.
int thread_count();

/// While a ThreadLimit exists, loops use `threads` threads (even more than the machine has cores), or one per core if
/// it is 0. The main thread must create and destroy limits, between loops, in reverse order.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  friend void detail::run_chunks(std::int64_t, std::int64_t, detail::ChunkBody, const void*);
  friend int thread_count();
  struct Arena;
  std::unique_ptr<Arena> arena_;
  ThreadLimit* outer_;
};

}  // namespace dspm
