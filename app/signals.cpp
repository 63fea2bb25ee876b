#include "app/signals.h"

#include "core/sudden_end.h"

namespace dspm {
namespace {

volatile std::sig_atomic_t received = 0;

extern "C" void on_signal(int number) {
  if (received != 0) end_suddenly(128 + number);
  received = number;
}

}  // namespace

InterruptRequests::InterruptRequests() {
  received = 0;
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, &interrupt_before_);
  sigaction(SIGTERM, &action, &terminate_before_);
}

InterruptRequests::~InterruptRequests() {
  sigaction(SIGINT, &interrupt_before_, nullptr);
  sigaction(SIGTERM, &terminate_before_, nullptr);
}

int InterruptRequests::signal() { return received; }

}  // namespace dspm
