// What a step that has not ended is busy with, if that has a name of its own: who waits for an iteration may like to know
// that it still learns.
#pragma once

#include <functional>

namespace dspm {

/// Lives while its thread is busy with it. Only one at a time has a name: the outer one.
class Activity {
 public:
  explicit Activity(const char* name);
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

  /// Null: nothing with a name. For any thread.
  static const char* now();
  /// Calls the listener with the name. By the thread that is busy.
  static void goes_on();
  /// Empty: nobody. Between activities.
  static void listen(std::function<void(const char* name)> listener);

 private:
  bool is_outer_;
};

}  // namespace dspm
