// Work that may be given up halfway: who holds a Cancellable says that nothing is lost by it.
#pragma once

namespace dspm {

/// What a loop throws that was given up; no error.
struct Cancelled {};

/// From here on loops within a Cancellable end with Cancelled, until work is allowed again. For signal handlers, too.
void cancel_work();
void allow_work();

/// While it lives, loops (core/parallel.h) may be given up: what they have done so far is thrown away. One at a time.
class Cancellable {
 public:
  Cancellable();
  ~Cancellable();
  Cancellable(const Cancellable&) = delete;
  Cancellable& operator=(const Cancellable&) = delete;

  /// Whether the loop that asks is to be given up.
  static bool is_cancelled();
};

}  // namespace dspm
