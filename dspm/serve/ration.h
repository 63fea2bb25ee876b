// How often something may interrupt the render, so that it takes no more than a small share of the time.
#pragma once

#include <chrono>

namespace dspm {

class Ration {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Ration(double share) : share_(share) {}

  bool is_due(Clock::time_point now = Clock::now()) const { return now >= next_; }
  /// It took from `begin` to `end`; it is due again once that is its share of the time.
  void took(Clock::time_point begin, Clock::time_point end = Clock::now()) {
    next_ = end + std::chrono::duration_cast<Clock::duration>((end - begin) * (1 / share_ - 1));
  }
  void reset() { next_ = {}; }

 private:
  double share_;
  Clock::time_point next_ = {};
};

}  // namespace dspm
