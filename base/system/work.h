// Estimates how far more threads than this machine has would help: the work of a computation, and its span, the part
// that no number of threads shortens. It is measured by the processor time of threads, so other programs do not disturb
// it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace dspm {

/// Processor time in seconds.
struct Work {
  double all = 0;   // of all threads
  double span = 0;  // of the longest chain of pieces that wait for one another

  /// The longest time that `threads` threads take if none idles while there is something to do. [Brent 1974]
  double seconds(int threads) const { return span + (all - span) / threads; }
  double speedup(int threads) const { return all > 0 ? all / seconds(threads) : 1; }
  /// The span's share of all work: Amdahl's serial share.
  double serial_share() const { return all > 0 ? span / all : 0; }

  Work& operator+=(const Work& o) {
    all += o.all, span += o.span;
    return *this;
  }
  Work& operator-=(const Work& o) {
    all -= o.all, span -= o.span;
    return *this;
  }
  friend Work operator-(Work a, const Work& b) { return a -= b; }
};

/// Starts to count work, which takes two looks at a thread's clock for each chunk of a loop.
void count_work();
/// The work that this thread and the loops that it ran have done since count_work(); nothing if it was never called.
Work work_done();

namespace detail {

/// The work of one thread in one chunk, or outside of all loops.
struct WorkAccount {
  Work work;
  double since = 0;  // by the thread's clock

  void pause();
  void go_on();
};

/// Exists as long as a loop. The thread that runs the loop waits; whatever it does meanwhile is a chunk's work.
class LoopWork {
 public:
  LoopWork();
  ~LoopWork();
  LoopWork(const LoopWork&) = delete;
  LoopWork& operator=(const LoopWork&) = delete;

  /// Exists as long as a chunk runs.
  class Chunk {
   public:
    explicit Chunk(LoopWork& loop);
    ~Chunk();
    Chunk(const Chunk&) = delete;
    Chunk& operator=(const Chunk&) = delete;

   private:
    LoopWork& loop_;
    WorkAccount account_;
    WorkAccount* outer_ = nullptr;
  };

 private:
  WorkAccount* account_ = nullptr;              // null: nothing is counted
  std::atomic<std::int64_t> all_{0}, span_{0};  // in ns
};

}  // namespace detail

/// Exists while a library works on threads that dspm's loops do not know. Its span cannot be seen, so it is estimated
/// from the time that the library takes on the threads that there are. [Karp and Flatt 1990]
class LibraryWork {
 public:
  explicit LibraryWork(int threads);
  ~LibraryWork();
  LibraryWork(const LibraryWork&) = delete;
  LibraryWork& operator=(const LibraryWork&) = delete;

 private:
  int threads_;
  detail::WorkAccount* account_ = nullptr;
  double processor_ = 0;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace dspm
