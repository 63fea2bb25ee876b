// The orders of viewers to the render. The threads that serve the page give orders, the one that renders takes them.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <optional>

namespace dspm {

/// Eye, target and up.
using LookAt = std::array<double, 9>;

class Orders {
 public:
  static constexpr int kMostIterations = 1'000'000'000;  // as in a checkpoint

  void pause(bool paused) { paused_ = paused; }
  void stop() { stopping_ = true; }
  void write() { write_ = true; }
  /// Returns false, and adds nothing, if that would be more than a run may have.
  bool add_iterations(int count) {
    int more = more_;
    do {
      if (more > kMostIterations - count) return false;
    } while (!more_.compare_exchange_weak(more, more + count));
    return true;
  }
  void restart() { restarting_ = true; }
  /// Places the camera in all frames; nullopt leaves it where the scene says.
  void place_camera(const std::optional<LookAt>& place) {
    const std::lock_guard lock(mutex_);
    camera_ = place, ++camera_changes_;
  }
  std::optional<LookAt> camera() const {
    const std::lock_guard lock(mutex_);
    return camera_;
  }
  /// The number of times that it was placed.
  int camera_changes() const { return camera_changes_; }
  /// Begins a run, as was asked for.
  void begin() { restarting_ = false, paused_ = false; }

  bool is_paused() const { return paused_; }
  bool is_stopping() const { return stopping_; }
  bool is_restarting() const { return restarting_; }
  bool take_write() { return write_.exchange(false); }
  int take_iterations() { return more_.exchange(0); }

 private:
  std::atomic<bool> paused_ = false, stopping_ = false, write_ = false, restarting_ = false;
  std::atomic<int> more_ = 0, camera_changes_ = 0;
  mutable std::mutex mutex_;
  std::optional<LookAt> camera_;
};

}  // namespace dspm
