// Work that may be cancelled halfway: whoever holds a Cancellable guarantees that nothing is lost.
#pragma once

namespace dspm {

/// Thrown by a loop that is cancelled; not an error.
struct Cancelled {};

/// From here on, loops within a Cancellable throw Cancelled until work is allowed again. Safe in signal handlers.
void cancel_work();
/// Cancels like cancel_work(), and declares all results so far useless: loops whose cancellation would lose them throw
/// as well.
void discard_work();
void allow_work();

/// While a Cancellable exists, loops (parallel.h) may be cancelled and their work so far discarded. Only one may
/// exist at a time.
class Cancellable {
 public:
  enum class Loss { nothing, results };
  explicit Cancellable(Loss loss = Loss::nothing);
  ~Cancellable();
  Cancellable(const Cancellable&) = delete;
  Cancellable& operator=(const Cancellable&) = delete;

  /// Returns whether the calling loop should stop.
  static bool is_cancelled();
};

}  // namespace dspm
