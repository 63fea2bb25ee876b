#include "core/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace dspm {

namespace {
ThreadLimit* innermost_limit = nullptr;
}  // namespace

// The control raises or lowers how many threads there are at all, the arena says how many of them a loop gets.
struct ThreadLimit::Arena {
  explicit Arena(int threads)
      : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}
  tbb::global_control control;
  tbb::task_arena arena;
};

ThreadLimit::ThreadLimit(int threads)
    : arena_(std::make_unique<Arena>(threads > 0 ? threads : tbb::info::default_concurrency())),
      outer_(innermost_limit) {
  innermost_limit = this;
}

ThreadLimit::~ThreadLimit() { innermost_limit = outer_; }

int thread_count() {
  return innermost_limit != nullptr ? innermost_limit->arena_->arena.max_concurrency()
                                    : tbb::this_task_arena::max_concurrency();
}

void detail::run_chunks(std::int64_t count, std::int64_t grain, ChunkBody body, const void* context) {
  const auto run_all = [=] {
    using Range = tbb::blocked_range<std::int64_t>;
    const auto run_some = [=](const Range& chunks) {
      for (std::int64_t c = chunks.begin(); c < chunks.end(); ++c) {
        body(context, c * grain, std::min(c * grain + grain, count));
      }
    };
    tbb::parallel_for(Range(0, chunk_count(count, grain)), run_some, tbb::simple_partitioner());
  };
  if (innermost_limit != nullptr) {
    innermost_limit->arena_->arena.execute(run_all);
  } else {
    run_all();
  }
}

}  // namespace dspm
