// Decides how often something may interrupt the render, so that it takes no more than a small share of the time.
#pragma once

#include <algorithm>
#include <chrono>

namespace dspm {

class Ration {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Ration(double share) : share_(share) {}

  bool is_due(Clock::time_point now = Clock::now()) const { return now >= next_; }
  /// Records that it took from `begin` to `end`; it is due again once that is its share of the time. What it took
  /// before it was due adds to the wait.
  void took(Clock::time_point begin, Clock::time_point end = Clock::now()) {
    next_ = std::max(next_, begin) + std::chrono::duration_cast<Clock::duration>((end - begin) / share_);
  }
  void reset() { next_ = {}; }

 private:
  double share_;
  Clock::time_point next_ = {};
};

}  // namespace dspm
