#include "dspm/app/run/signals.h"

#include <time.h>
#include <unistd.h>

#include "dspm/base/system/cancellation.h"
#include "dspm/base/system/sudden_end.h"

namespace dspm {
namespace {

constexpr time_t kSecondsToFinish = 10;  // an iteration

volatile std::sig_atomic_t received = 0, images_wanted = 0, is_terminal = 0;
// Not alarm(): whoever has started the program may have set one, which ends the run as SIGTERM does.
timer_t time_to_finish;
bool has_timer = false;

int signal_of_timer() { return SIGRTMIN + 6; }

void set_timer(time_t seconds) {
  const itimerspec once{{}, {seconds, 0}};
  if (has_timer) timer_settime(time_to_finish, 0, &once, nullptr);
}

extern "C" void on_end_wanted(int number) {
  constexpr char kWord[] =
      "\ndspm: ending after this iteration, which is cancelled in ten seconds if possible; Ctrl-C again ends at once\n";
  const bool is_by_person = number == SIGINT || number == SIGTERM;
  if (received != 0 && !is_by_person) return;  // the system repeats SIGXCPU every second
  if (received != 0) end_suddenly(128 + number);
  received = number;
  set_timer(kSecondsToFinish);
  if (is_terminal != 0 && write(STDERR_FILENO, kWord, sizeof kWord - 1) < 0) return;
}
extern "C" void on_time_over(int) {
  if (received != 0) cancel_work();
}
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
  handlers_.handle(signal_of_timer(), on_time_over);
  sigevent event = {};
  event.sigev_notify = SIGEV_SIGNAL, event.sigev_signo = signal_of_timer();
  has_timer = timer_create(CLOCK_MONOTONIC, &event, &time_to_finish) == 0;
  for (const int signal : {SIGINT, SIGTERM, SIGALRM, SIGXCPU, SIGUSR2}) handlers_.handle(signal, on_end_wanted);
}

InterruptRequests::~InterruptRequests() {
  if (has_timer) timer_delete(time_to_finish);
  has_timer = false;
}

int InterruptRequests::signal() { return received; }

}  // namespace dspm
