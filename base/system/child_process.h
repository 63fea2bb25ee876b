// Another program, run without a shell and fed through its standard input.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/base/system/sudden_end.h"

namespace dspm {

/// Keeps the program's standard error and drops its standard output. Ctrl-C does not reach the program: it lives until
/// it is waited for.
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;
  /// Called several times a second while waiting for the program, which has taken no input and written nothing since
  /// `last_sign`. The program is killed if it returns true.
  using GiveUp = std::function<bool(Clock::time_point last_sign)>;

  /// Starts the program, which is the first word and is looked up in PATH. Throws std::system_error if it cannot be
  /// run.
  explicit ChildProcess(const std::vector<std::string>& words, GiveUp give_up = {});
  /// Kills the program, unless it was waited for.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Writes to its standard input. Input that a program does not read is dropped; wait() returns why.
  void write(std::string_view bytes);
  /// Closes its input. Returns its exit code, or 128 + the signal that ended it.
  int wait();
  /// Returns its standard error so far, without the last line's end; only the beginning if it is long.
  const std::string& errors() const { return errors_; }
  /// Returns whether GiveUp had it killed.
  bool was_given_up() const { return given_up_; }

 private:
  struct Descriptor {
    int number = -1;
    ~Descriptor() { close(); }
    void close();
  };
  /// Waits until it writes something, takes input (if there is any), or a moment has passed.
  void await_sign(bool has_input);
  void hear();

  GiveUp give_up_;
  Descriptor input_, said_;
  std::string errors_;
  Clock::time_point last_sign_ = Clock::now();
  bool given_up_ = false;
  pid_t process_ = 0;  // 0: it has ended
  std::optional<Leftover> leftover_;
};

}  // namespace dspm
