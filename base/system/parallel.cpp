#include "dspm/base/system/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "dspm/base/system/cancellation.h"
#include "dspm/base/system/cpu_quota.h"
#include "dspm/base/system/thread_sanitizer.h"
#include "dspm/base/system/work.h"

#ifdef DSPM_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
extern "C" const char* __tsan_default_suppressions() { return dspm::kNotJudged; }
#endif

namespace dspm {

namespace {

ThreadLimit* innermost_limit = nullptr;

// The thread sanitizer does not see how TBB orders threads, because the library is not built for it. So this file is
// not instrumented (CMakeLists.txt) and states the order itself: seen_after(event) follows done_before(event).
#ifdef DSPM_THREAD_SANITIZER
void done_before(char& event) { __tsan_release(&event); }
void seen_after(char& event) { __tsan_acquire(&event); }
#else
void done_before(char&) {}
void seen_after(char&) {}
#endif

/// Exists as long as a loop: its chunks see all work before it, and the code after it sees all of theirs.
class LoopOrder {
 public:
  LoopOrder() { done_before(started_); }
  ~LoopOrder() { seen_after(ended_); }
  LoopOrder(const LoopOrder&) = delete;
  LoopOrder& operator=(const LoopOrder&) = delete;

  /// Exists as long as a chunk runs.
  class Chunk {
   public:
    explicit Chunk(LoopOrder& loop) : loop_(loop) { seen_after(loop_.started_); }
    ~Chunk() { done_before(loop_.ended_); }
    Chunk(const Chunk&) = delete;
    Chunk& operator=(const Chunk&) = delete;

   private:
    LoopOrder& loop_;
  };

 private:
  char started_ = 0, ended_ = 0;
};

/// Returns one thread per core that the program may use, but no more than a container's quota keeps busy.
int usual_threads() {
  const int cores = tbb::info::default_concurrency();
  const std::optional<double> quota = cpu_quota();
  return quota && *quota < cores ? std::max(1, static_cast<int>(std::ceil(*quota))) : cores;
}

}  // namespace

// The control raises or lowers the total number of threads; the arena limits how many of them a loop gets. It has a
// place for a second thread with a loop of its own, which reads an edited scene while the first one renders: it would
// have to wait for the end of the first one's loop otherwise.
struct ThreadLimit::Arena {
  static constexpr int kLoops = 2;
  explicit Arena(int count)
      : threads(count),
        control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count)),
        arena(count + kLoops - 1, kLoops) {}
  int threads;
  tbb::global_control control;
  tbb::task_arena arena;
};

ThreadLimit::ThreadLimit(int threads)
    : arena_(std::make_unique<Arena>(threads > 0 ? threads : usual_threads())), outer_(innermost_limit) {
  innermost_limit = this;
}

ThreadLimit::~ThreadLimit() { innermost_limit = outer_; }

int thread_count() {
  return innermost_limit != nullptr ? innermost_limit->arena_->threads : tbb::this_task_arena::max_concurrency();
}

void detail::run_chunks(std::int64_t count, std::int64_t grain, ChunkBody body, const void* context) {
  const auto run_one = [&](std::int64_t c) {
    if (Cancellable::is_cancelled()) throw Cancelled{};
    body(context, c * grain, std::min(c * grain + grain, count));
  };
  if (chunk_count(count, grain) == 1) return run_one(0);  // nothing to share out
  LoopOrder order;
  LoopWork work;
  const auto run_some = [&](const tbb::blocked_range<std::int64_t>& chunks) {
    for (std::int64_t c = chunks.begin(); c < chunks.end(); ++c) {
      const LoopOrder::Chunk chunk(order);
      const LoopWork::Chunk worked(work);
      run_one(c);
    }
  };
  const auto run_all = [&] {
    const tbb::blocked_range<std::int64_t> chunks(0, chunk_count(count, grain));
    tbb::parallel_for(chunks, run_some, tbb::simple_partitioner());
  };
  if (innermost_limit != nullptr) {
    innermost_limit->arena_->arena.execute(run_all);
  } else {
    run_all();
  }
}

}  // namespace dspm
