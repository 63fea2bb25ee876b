#include "dspm/system/cancellation.h"

#include <atomic>

namespace dspm {
namespace {

std::atomic<bool> cancelled = false, allowed = false;

}  // namespace

void cancel_work() { cancelled = true; }
void allow_work() { cancelled = false; }

Cancellable::Cancellable() { allowed = true; }
Cancellable::~Cancellable() { allowed = false; }

bool Cancellable::is_cancelled() {
  return allowed.load(std::memory_order_relaxed) && cancelled.load(std::memory_order_relaxed);
}

}  // namespace dspm
