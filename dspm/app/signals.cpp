#include "dspm/app/signals.h"

#include <unistd.h>

#include "dspm/system/cancellation.h"
#include "dspm/system/sudden_end.h"

namespace dspm {
namespace {

constexpr unsigned kSecondsToFinish = 10;  // an iteration

volatile std::sig_atomic_t received = 0, images_wanted = 0, is_terminal = 0;

extern "C" void on_end_wanted(int number) {
  constexpr char kWord[] =
      "\ndspm: ending after this iteration, which is cancelled in ten seconds if possible; Ctrl-C again ends at once\n";
  const bool is_by_person = number == SIGINT || number == SIGTERM;
  if (received != 0 && !is_by_person) return;  // the system repeats SIGXCPU every second
  if (received != 0) end_suddenly(128 + number);
  received = number;
  alarm(kSecondsToFinish);
  if (is_terminal != 0 && write(STDERR_FILENO, kWord, sizeof kWord - 1) < 0) return;
}
extern "C" void on_time_over(int) { cancel_work(); }
extern "C" void on_images_wanted(int) { images_wanted = 1; }

}  // namespace

SignalHandlers::~SignalHandlers() {
  for (const auto& [signal, action] : before_) sigaction(signal, &action, nullptr);
}

void SignalHandlers::handle(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, &before_[signal]);
}

ImageRequests::ImageRequests() {
  images_wanted = 0;
  handlers_.handle(SIGHUP, on_images_wanted);
  handlers_.handle(SIGUSR1, on_images_wanted);
}

bool ImageRequests::take() {
  const bool wanted = images_wanted != 0;
  images_wanted = 0;
  return wanted;
}

InterruptRequests::InterruptRequests() {
  received = 0;
  is_terminal = isatty(STDERR_FILENO);
  allow_work();
  handlers_.handle(SIGINT, on_end_wanted);
  handlers_.handle(SIGTERM, on_end_wanted);
  handlers_.handle(SIGXCPU, on_end_wanted);
  handlers_.handle(SIGUSR2, on_end_wanted);
  handlers_.handle(SIGALRM, on_time_over);
}

InterruptRequests::~InterruptRequests() { alarm(0); }

int InterruptRequests::signal() { return received; }

}  // namespace dspm
