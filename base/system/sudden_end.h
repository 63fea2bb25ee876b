// Cleans up after a process that ends without unwinding, as on the second Ctrl-C: temporary files and other programs.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace dspm {

/// Removes the files and kills the programs of all Leftovers, as the process is about to end: other threads make none
/// any more. For signal handlers.
void remove_leftovers();
/// Calls remove_leftovers(), and ends the process with this exit code. For signal handlers.
[[noreturn]] void end_suddenly(int code);

/// While a Leftover exists, remove_leftovers() removes its file, or kills its program. There is room for a few at a
/// time; any others are left over.
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
  friend void remove_leftovers();

  Slot* slot_;  // null: no room
};

/// While it exists, the calling thread creates a Leftover's file: a sudden end by another thread waits for it.
class LeftoverBegins {
 public:
  /// Does not return once the process ends.
  LeftoverBegins();
  ~LeftoverBegins();
  LeftoverBegins(const LeftoverBegins&) = delete;
  LeftoverBegins& operator=(const LeftoverBegins&) = delete;
};

}  // namespace dspm
