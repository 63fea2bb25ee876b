#include "dspm/app/last_words.h"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "dspm/system/sudden_end.h"

namespace dspm {
namespace {

/// Takes no memory: there may be none.
void say(std::string_view words) { static_cast<void>(!write(STDERR_FILENO, words.data(), words.size())); }

void on_terminate() {
  static std::atomic<pid_t> speaker = 0;
  pid_t nobody = 0;
  if (!speaker.compare_exchange_strong(nobody, gettid())) {
    if (nobody == gettid()) _exit(1);  // while it spoke
    while (true) pause();              // the other thread ends the process
  }
  const std::exception_ptr exception = std::current_exception();
  if (!exception) std::abort();
  say("dspm: ended: ");
  try {
    std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    say("out of memory");
  } catch (const std::exception& error) {
    say(error.what());
  } catch (...) {
    say("something that is not a std::exception was thrown");
  }
  say("\n");
  end_suddenly(1);
}

}  // namespace

void prepare_last_words() { std::set_terminate(on_terminate); }

}  // namespace dspm
