#include "dspm/app/run/last_words.h"

#include <execinfo.h>
#include <signal.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include "dspm/base/system/sudden_end.h"
#include "dspm/session/modules/all_plugins.h"
#include "dspm/session/modules/blame.h"

namespace dspm {
namespace {

/// A text in a fixed place: a crash may come at any moment, and there may be no memory.
struct Text {
  char text[1024] = "";

  void set(std::string_view words) {
    const std::size_t count = std::min(words.size(), sizeof text - 1);
    std::copy_n(words.begin(), count, text);
    text[count] = 0;
  }
  bool empty() const { return text[0] == 0; }
};
Text current_step, own_name, kept_files;
std::array<Text, kMostModules> module_names;  // in the order of loaded_modules()
std::atomic<bool> rendering = false;
std::atomic<pid_t> program_process = 0;  // the process, from the start of main() to its end

void say(std::string_view words) { static_cast<void>(!write(STDERR_FILENO, words.data(), words.size())); }

/// Returns true for the first thread, and false if that thread fails again while it speaks. Other threads wait here for
/// the end.
bool first_to_speak() {
  static std::atomic<pid_t> speaker = 0;
  pid_t nobody = 0;
  if (speaker.compare_exchange_strong(nobody, gettid())) return true;
  while (nobody != gettid()) pause();  // the other thread ends the process
  return false;
}

void say_cause(std::string_view cause) {
  say("dspm: ended");
  if (rendering && !current_step.empty()) say(" in "), say(current_step.text);
  say(": ");
  say(cause);
}

void say_culprit(const LoadedModule* module) {
  const Text& name =
      module != nullptr ? module_names[static_cast<std::size_t>(module - loaded_modules().data())] : own_name;
  if (rendering && !name.empty()) say(", at work: "), say(name.text);
  say("\n");
}

void say_what_is_left() {
  if (!rendering || kept_files.empty()) return;
  say("dspm: ");
  say(kept_files.text);
  say("\n");
}

const char* what_was_thrown(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& error) {
    return error.what();  // lives as long as `exception`
  } catch (...) {
    return "something that is not a std::exception was thrown";
  }
}

void on_terminate() {
  const std::exception_ptr exception = std::current_exception();
  if (!exception) std::abort();
  if (!first_to_speak()) end_suddenly(1);
  const LoadedModule* const module = module_that_threw();
  say_cause(what_was_thrown(exception));
  say_culprit(module);
  say_what_is_left();
  end_suddenly(1);
}

[[noreturn]] void end_as_called(const char* function) {
  if (!first_to_speak()) end_suddenly(1);
  say_cause(function);
  say_culprit(module_on_stack());
  say_what_is_left();
  end_suddenly(1);
}

void on_exit() {
  if (rendering || program_process == getpid()) end_as_called("exit() was called");
}

/// Speaks if a module is ending the process: its exit code would stand for that of the run. Programs that are about to
/// be started are no concern.
void on_end_of_process(const char* function) {
  if (program_process == getpid() && module_on_stack() != nullptr) end_as_called(function);
}

void on_crash(int number) {
  if (first_to_speak()) {
    say_cause(sigdescr_np(number));
    say_culprit(module_on_stack());
    say_what_is_left();
    remove_leftovers();
  }
  signal(number, SIG_DFL);
  raise(number);  // takes effect when this returns
}

/// Handles crashes. Handlers of others stay, such as a sanitizer's.
void handle_crashes() {
  static std::array<char, 1 << 16> stack;  // the main thread's own may be exhausted
  const stack_t room{stack.data(), 0, stack.size()};
  stack_t other = {};
  if (sigaltstack(nullptr, &other) == 0 && (other.ss_flags & SS_DISABLE) != 0) sigaltstack(&room, nullptr);
  struct sigaction action = {};
  action.sa_handler = on_crash;
  action.sa_flags = SA_ONSTACK;
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    struct sigaction before = {};
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) sigaction(number, &action, nullptr);
  }
}

}  // namespace

void prepare_last_words() {
  program_process = getpid();
  std::atexit(on_exit);
  std::set_terminate(on_terminate);
  std::array<void*, 1> first_use;  // it loads libgcc, which a signal handler must not
  backtrace(first_use.data(), 1);
  handle_crashes();
}

int end_as_meant(int code) {
  program_process = 0;
  return code;
}

LastWords::LastWords() {
  current_step.set(""), own_name.set(""), kept_files.set("");
  std::atexit(on_exit);
  know_modules();
  rendering = true;
}

LastWords::~LastWords() { rendering = false; }

void LastWords::begin(std::string_view step, std::string_view own) {
  know_modules();
  current_step.set(step), own_name.set(own);
}

void LastWords::keep(std::string_view files) { kept_files.set(files); }

// on_exit() is registered again, so that it comes before the destructors of new modules.
void LastWords::know_modules() {
  if (known_modules_ == loaded_modules().size()) return;
  for (; known_modules_ < loaded_modules().size(); ++known_modules_)
    module_names[known_modules_].set(in_words(loaded_modules()[known_modules_]));
  std::atexit(on_exit);
}

}  // namespace dspm

// They take the place of the C library's for modules (exported.map), as exit codes must say what happened.
extern "C" {

void _exit(int code) {
  dspm::on_end_of_process("_exit() was called");
  for (;;) syscall(SYS_exit_group, code);
}

void _Exit(int code) noexcept {
  dspm::on_end_of_process("_Exit() was called");
  for (;;) syscall(SYS_exit_group, code);
}

void quick_exit(int code) noexcept {
  dspm::on_end_of_process("quick_exit() was called");
  for (;;) syscall(SYS_exit_group, code);
}
}
