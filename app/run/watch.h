// Reports who is at work when a step takes so long that it may never end.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace dspm {

class Watch {
 public:
  /// A step may take `patience` seconds; then a message says so, and again after twice the time, and so on. Throws
  /// std::runtime_error if it cannot start its thread.
  explicit Watch(double patience);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Begins a new step: "iteration 3". `own` names who does it if no module is found at work; it may be empty.
  void begin(std::string step, std::string own);
  std::string step() const { return step_; }

 private:
  using Clock = std::chrono::steady_clock;
  void run();
  std::string complaint() const;

  const Clock::duration patience_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string step_, own_;
  Clock::time_point begin_, next_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace dspm
