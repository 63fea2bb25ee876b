// What viewers want the render to do. Given by threads that serve the page, taken by the one that renders.
#pragma once

#include <atomic>

namespace dspm {

class Orders {
 public:
  void pause(bool paused) { paused_ = paused; }
  void stop() { stopping_ = true; }
  void write() { write_ = true; }
  void add_iterations(int count) { more_ += count; }

  bool is_paused() const { return paused_; }
  bool is_stopping() const { return stopping_; }
  bool take_write() { return write_.exchange(false); }
  int take_iterations() { return more_.exchange(0); }

 private:
  std::atomic<bool> paused_ = false, stopping_ = false, write_ = false;
  std::atomic<int> more_ = 0;
};

}  // namespace dspm
