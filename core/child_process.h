// Another program, run without a shell and fed through its standard input.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

namespace dspm {

/// What the program writes to standard error is shown as if it were ours, its standard output is dropped. Ctrl-C does
/// not reach it: it lives until it is waited for.
class ChildProcess {
 public:
  /// The first word is the program, which is looked up in PATH. Throws std::system_error where it cannot be run.
  explicit ChildProcess(const std::vector<std::string>& words);
  /// Kills it, unless it was waited for.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// To its standard input. What a program does not read is dropped; it has a reason, which wait() returns.
  void write(std::string_view bytes) const;
  /// Ends its input. Its exit code, or 128 + the signal that ended it.
  int wait();

 private:
  int input_ = -1;
  pid_t process_ = 0;  // 0: it is no more
};

}  // namespace dspm
