// Ctrl-C while rendering: the first asks for an end after the iteration, the second ends the program at once.
#pragma once

#include <csignal>

namespace dspm {

/// While it lives, SIGINT and SIGTERM are such requests.
class InterruptRequests {
 public:
  InterruptRequests();
  ~InterruptRequests();
  InterruptRequests(const InterruptRequests&) = delete;
  InterruptRequests& operator=(const InterruptRequests&) = delete;

  /// The signal that came; 0: none. The exit code is 128 + signal, 130 for Ctrl-C.
  static int signal();

 private:
  struct sigaction interrupt_before_, terminate_before_;
};

}  // namespace dspm
