// Signals from the moment on where files are written. The first Ctrl-C asks for an end after the iteration, or within ten
// seconds where that can be given up; the second ends the program at once. SIGHUP and SIGUSR1 ask for the images so far.
#pragma once

#include <csignal>
#include <map>

namespace dspm {

/// While it lives, SIGINT, SIGTERM, SIGHUP and SIGUSR1 are such requests.
class InterruptRequests {
 public:
  InterruptRequests();
  ~InterruptRequests();
  InterruptRequests(const InterruptRequests&) = delete;
  InterruptRequests& operator=(const InterruptRequests&) = delete;

  /// The signal that came; 0: none. It is remembered.
  static int signal();
  /// Whether images were asked for since the last call.
  static bool take_write_request();
  /// 128 + the signal that came, 130 for Ctrl-C; `otherwise` where none did.
  static int exit_code(int otherwise) { return signal() != 0 ? 128 + signal() : otherwise; }

 private:
  std::map<int, struct sigaction> before_;
};

}  // namespace dspm
