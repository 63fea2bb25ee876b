#include "app/signals.h"

#include <unistd.h>

#include "core/cancellation.h"
#include "core/sudden_end.h"

namespace dspm {
namespace {

constexpr unsigned kSecondsToFinish = 10;  // an iteration

volatile std::sig_atomic_t received = 0, images_wanted = 0;

extern "C" void on_end_wanted(int number) {
  if (received != 0) end_suddenly(128 + number);
  received = number;
  alarm(kSecondsToFinish);
}
extern "C" void on_time_over(int) { cancel_work(); }
extern "C" void on_images_wanted(int) { images_wanted = 1; }

}  // namespace

InterruptRequests::InterruptRequests() {
  received = 0;
  images_wanted = 0;
  allow_work();
  const auto handle = [&](int number, void (*handler)(int)) {
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigaction(number, &action, &before_[number]);
  };
  handle(SIGINT, on_end_wanted);
  handle(SIGTERM, on_end_wanted);
  handle(SIGALRM, on_time_over);
  handle(SIGHUP, on_images_wanted);
  handle(SIGUSR1, on_images_wanted);
}

InterruptRequests::~InterruptRequests() {
  alarm(0);
  for (const auto& [number, action] : before_) sigaction(number, &action, nullptr);
}

int InterruptRequests::signal() { return received; }

bool InterruptRequests::take_write_request() {
  const bool wanted = images_wanted != 0;
  images_wanted = 0;
  return wanted;
}

}  // namespace dspm
