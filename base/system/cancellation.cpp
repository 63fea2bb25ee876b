#include "dspm/base/system/cancellation.h"

#include <atomic>

namespace dspm {
namespace {

constexpr int kCancelled = 1, kDiscarded = 2;   // as wanted
constexpr int kMayLose = 1, kLosesNothing = 2;  // as the loop is
std::atomic<int> wanted = 0, running_loop = 0;

}  // namespace

void cancel_work() {
  int none = 0;
  wanted.compare_exchange_strong(none, kCancelled);
}
void discard_work() { wanted = kDiscarded; }
void allow_work() { wanted = 0; }

Cancellable::Cancellable(Loss loss) { running_loop = loss == Loss::nothing ? kLosesNothing : kMayLose; }
Cancellable::~Cancellable() { running_loop = 0; }

/// Both requests end a loop that loses nothing; only discarding ends one that loses results.
bool Cancellable::is_cancelled() {
  return running_loop.load(std::memory_order_relaxed) + wanted.load(std::memory_order_relaxed) >= 3;
}

}  // namespace dspm
