// Signals to a run. The first Ctrl-C asks for an end after the iteration, which is cancelled after ten seconds if it
// can be (cancellation.h); the second ends the program at once. SIGHUP and SIGUSR1 ask for the images so far.
#pragma once

#include <csignal>
#include <map>

namespace dspm {

/// Handles signals as long as it exists.
class SignalHandlers {
 public:
  SignalHandlers() = default;
  ~SignalHandlers();
  SignalHandlers(const SignalHandlers&) = delete;
  SignalHandlers& operator=(const SignalHandlers&) = delete;
  void handle(int signal, void (*handler)(int));

 private:
  std::map<int, struct sigaction> before_;
};

/// Handles SIGHUP and SIGUSR1, from the start of a run.
class ImageRequests {
 public:
  ImageRequests();
  /// Returns whether images were asked for since the last call.
  static bool take();

 private:
  SignalHandlers handlers_;
};

/// Handles SIGINT, SIGTERM and SIGALRM, and SIGXCPU and SIGUSR2, by which schedulers warn, from the moment that files
/// are written.
class InterruptRequests {
 public:
  InterruptRequests();
  ~InterruptRequests();
  InterruptRequests(const InterruptRequests&) = delete;
  InterruptRequests& operator=(const InterruptRequests&) = delete;

  /// Returns the signal that came, now or earlier; 0 if none did.
  static int signal();
  /// Returns 128 + the signal that came, 130 for Ctrl-C; `otherwise` if none did.
  static int exit_code(int otherwise) { return signal() != 0 ? 128 + signal() : otherwise; }

 private:
  SignalHandlers handlers_;
};

}  // namespace dspm
