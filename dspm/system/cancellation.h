// Work that may be cancelled halfway: whoever holds a Cancellable guarantees that nothing is lost.
#pragma once

namespace dspm {

/// Thrown by a loop that is cancelled; not an error.
struct Cancelled {};

/// From here on, loops within a Cancellable throw Cancelled until work is allowed again. Safe in signal handlers.
void cancel_work();
/// Likewise, and all results so far are of no use: so do loops whose cancellation would lose them.
void discard_work();
void allow_work();

/// While it lives, loops (system/parallel.h) may be cancelled and their work so far discarded. One at a time.
class Cancellable {
 public:
  enum class Loss { nothing, results };
  explicit Cancellable(Loss loss = Loss::nothing);
  ~Cancellable();
  Cancellable(const Cancellable&) = delete;
  Cancellable& operator=(const Cancellable&) = delete;

  /// Whether the calling loop should stop.
  static bool is_cancelled();
};

}  // namespace dspm
