#include "dspm/base/system/standard_streams.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <mutex>
#include <system_error>
#include <utility>

#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/message_listener.h"

namespace dspm {
namespace {

/// Occupies the number of a closed stream, which would go to the next file that is opened. Opened for the wrong
/// direction, it still fails.
void occupy(int stream, int flags) {
  if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", flags) != stream) _exit(1);
}

std::mutex listening;
std::function<void(std::string_view)> the_listener;

}  // namespace

void prepare_standard_streams() {
  occupy(STDIN_FILENO, O_WRONLY);
  occupy(STDOUT_FILENO, O_RDONLY);
  occupy(STDERR_FILENO, O_RDONLY);
  for (const int number : {SIGPIPE, SIGXFSZ}) signal(number, SIG_IGN);
}

void print_data(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) < text.size() || std::fflush(stdout) != 0)
    throw WriteError("standard output", std::generic_category().message(errno));
}

void print_message(std::string_view text) {
  {
    const std::lock_guard lock(listening);
    if (the_listener) the_listener(text);
  }
  print_picture(text);
}

void listen_to_messages(std::function<void(std::string_view)> listener) {
  const std::lock_guard lock(listening);
  the_listener = std::move(listener);
}

void print_picture(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace dspm
