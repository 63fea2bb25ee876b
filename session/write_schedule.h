// Decides when to write something between iterations.
#pragma once

#include <chrono>
#include <utility>

namespace dspm {

/// Every so many seconds or iterations; never if both are zero.
struct Interval {
  double seconds = 0;
  int iterations = 0;
};

class WriteSchedule {
 public:
  explicit WriteSchedule(const Interval& every) : every_(every) {}
  /// Counts iterations from here: those of a frame interval, `done` of which a checkpoint held. The clock goes on.
  void begin(int done) { asked_ = done; }
  /// Returns whether to write after that many iterations, which may be several more than at the last call; if so, the
  /// clock starts anew.
  bool due(int iterations) {
    const std::chrono::duration<double> passed = Clock::now() - last_;
    const int before = std::exchange(asked_, iterations);
    const bool yes = (every_.iterations > 0 && iterations / every_.iterations > before / every_.iterations) ||
                     (every_.seconds > 0 && passed.count() >= every_.seconds);
    if (yes) last_ = Clock::now();
    return yes;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Interval every_;
  Clock::time_point last_ = Clock::now();
  int asked_ = 0;  // iterations at the last call
};

}  // namespace dspm
