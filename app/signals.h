// Ctrl-C from the moment on where files are written: the first asks for an end after the iteration, the second ends the
// program at once.
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

  /// The signal that came; 0: none. It is remembered.
  static int signal();
  /// 128 + the signal that came, 130 for Ctrl-C; `otherwise` where none did.
  static int exit_code(int otherwise) { return signal() != 0 ? 128 + signal() : otherwise; }

 private:
  struct sigaction interrupt_before_, terminate_before_;
};

}  // namespace dspm
