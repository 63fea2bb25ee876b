// Loops over many threads; the only place that knows TBB (see parallel.cpp). Which thread does what, and when, is open:
// a body may only write to slots of its own. How the range is cut depends on count and grain alone, so whatever is
// kept per chunk is the same with any number of threads.
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>

namespace dspm {

namespace detail {
using ChunkBody = void (*)(const void* context, std::int64_t begin, std::int64_t end);
void run_chunks(std::int64_t count, std::int64_t grain, ChunkBody body, const void* context);
}  // namespace detail

/// Calls body(begin, end) for [0, grain), [grain, 2 grain), ... up to count, in parallel. When a body throws, chunks
/// that have not begun may be left out, and one of the exceptions thrown comes out of here. So may Cancelled (see
/// core/cancellation.h).
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

/// As many chunks as parallel_chunks calls: chunk c begins at c * grain.
constexpr std::int64_t chunk_count(std::int64_t count, std::int64_t grain) {
  return count <= 0 ? 0 : (count - 1) / grain + 1;
}

/// How many threads a loop may use.
int thread_count();

/// While it lives, loops use `threads` threads (also more than the machine has cores); 0: as many as there are cores.
/// To be made and destroyed by the main thread, between loops, the last made first.
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
