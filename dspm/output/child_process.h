// Another program, run without a shell and fed through its standard input.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/system/sudden_end.h"

namespace dspm {

/// What the program writes to standard error is kept, its standard output is dropped. Ctrl-C does not reach it: it
/// lives until it is waited for.
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;
  /// Asked several times a second while there is nothing to do but to wait for the program, which has taken no input
  /// and said nothing since `last_sign`: whether that is enough. Then it is killed.
  using GiveUp = std::function<bool(Clock::time_point last_sign)>;

  /// The first word is the program, which is looked up in PATH. Throws std::system_error where it cannot be run.
  explicit ChildProcess(const std::vector<std::string>& words, GiveUp give_up = {});
  /// Kills it, unless it was waited for.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// To its standard input. What a program does not read is dropped; it has a reason, which wait() returns.
  void write(std::string_view bytes);
  /// Ends its input. Its exit code, or 128 + the signal that ended it.
  int wait();
  /// What it wrote to standard error so far, without the last line's end; no more than the beginning where it is much.
  const std::string& errors() const { return errors_; }
  /// It was killed as GiveUp had it.
  bool was_given_up() const { return given_up_; }

 private:
  struct Descriptor {
    int number = -1;
    ~Descriptor() { close(); }
    void close();
  };
  /// Until it says something, takes input (where there is some), or a moment has passed.
  void await_sign(bool has_input);
  void hear();

  GiveUp give_up_;
  Descriptor input_, said_;
  std::string errors_;
  Clock::time_point last_sign_ = Clock::now();
  bool given_up_ = false;
  pid_t process_ = 0;  // 0: it is no more
  std::optional<Leftover> leftover_;
};

}  // namespace dspm
