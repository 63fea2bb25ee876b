// Cleans up after a process that ends without unwinding, as on the second Ctrl-C: temporary files and other programs.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace dspm {

/// Ends the process with this exit code. For signal handlers.
[[noreturn]] void end_suddenly(int code);

/// While it lives, end_suddenly() removes the file, or kills the program. There is room for a few at a time; any others
/// are left over.
class Leftover {
 public:
  explicit Leftover(const std::filesystem::path& file);
  explicit Leftover(pid_t program);
  ~Leftover();
  Leftover(const Leftover&) = delete;
  Leftover& operator=(const Leftover&) = delete;

 private:
  struct Slot;
  static Slot* take();
  friend void end_suddenly(int code);

  Slot* slot_;  // null: no room
};

}  // namespace dspm
