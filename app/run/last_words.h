// A process that ends abnormally still says why: an exception that cannot be caught, as when a library's thread runs
// out of memory; a crash; exit() or _exit() in a module.
#pragma once

#include <cstddef>
#include <string_view>

namespace dspm {

/// Makes such an end report itself on standard error from now on, and leave no temporary file. A crash ends the process
/// by its signal, other ends have exit code 1. Until end_as_meant(), exit(), and whatever a module calls to end the
/// process, is such an end.
void prepare_last_words();
/// Returns the exit code, as main() must return it.
int end_as_meant(int code);

/// While a LastWords exists, a render is under way: exit() is a failure, and last words say what was being done, which
/// module was running, and what the render leaves behind. At most one may exist.
class LastWords {
 public:
  LastWords();
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;

  /// Begins a step: "iteration 3". `own` names who does it if no module is found at work; it may be empty.
  void begin(std::string_view step, std::string_view own);
  /// Remembers what has been rendered so far and where it lies, in words.
  void keep(std::string_view files);

 private:
  void know_modules();
  std::size_t known_modules_ = 0;
};

}  // namespace dspm
