#include "dspm/base/system/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace dspm {
namespace {

constexpr int kBetweenPolls = 20;                // milliseconds
constexpr std::size_t kMostErrors = 4096;        // bytes
constexpr std::string_view kLineEnds = "\r\n ";  // stripped from the end of errors

[[noreturn]] void fail(int error, const std::vector<std::string>& words) {
  throw std::system_error(error, std::generic_category(), words.front());
}

/// Returns the error number, or 0.
int spawn(pid_t& process, const std::vector<std::string>& words, int input, int errors) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // Ctrl-C is for the terminal's process group
  posix_spawnattr_setpgroup(&attributes, 0);
  const int error = posix_spawnp(&process, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

}  // namespace

void ChildProcess::Descriptor::close() {
  if (number >= 0) ::close(std::exchange(number, -1));
}

ChildProcess::ChildProcess(const std::vector<std::string>& words, GiveUp give_up) : give_up_(std::move(give_up)) {
  // Sockets instead of a pipe, because send() can avoid SIGPIPE.
  int input[2], errors[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input) != 0) fail(errno, words);
  input_.number = input[0];
  const Descriptor its_input{input[1]};
  if (pipe2(errors, O_CLOEXEC) != 0) fail(errno, words);
  said_.number = errors[0];
  const Descriptor its_errors{errors[1]};
  fcntl(said_.number, F_SETFL, O_NONBLOCK);
  if (const int error = spawn(process_, words, its_input.number, its_errors.number)) {
    process_ = 0;
    fail(error, words);
  }
  leftover_.emplace(process_);
}

ChildProcess::~ChildProcess() {
  if (process_ == 0) return;
  kill(process_, SIGKILL);
  wait();
}

void ChildProcess::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = send(input_.number, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno != EINTR && errno != EAGAIN) return;
    if (sent < 0) {
      await_sign(true);
    } else {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
      last_sign_ = Clock::now();
    }
  }
}

int ChildProcess::wait() {
  input_.close();
  last_sign_ = Clock::now();
  int status = 0;
  while (waitpid(process_, &status, WNOHANG) == 0) await_sign(false);
  process_ = 0;
  leftover_.reset();
  hear();
  errors_.erase(std::min(errors_.find_last_not_of(kLineEnds) + 1, errors_.size()));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void ChildProcess::await_sign(bool has_input) {
  pollfd ends[] = {{has_input ? input_.number : -1, POLLOUT, 0}, {said_.number, POLLIN, 0}};
  poll(ends, 2, kBetweenPolls);
  if (ends[1].revents != 0) hear();
  if (process_ == 0 || !give_up_ || given_up_ || !give_up_(last_sign_)) return;
  given_up_ = true;
  kill(process_, SIGKILL);
}

void ChildProcess::hear() {
  std::array<char, 4096> bytes;
  ssize_t count;
  while ((count = read(said_.number, bytes.data(), bytes.size())) > 0) {
    errors_.append(bytes.data(), std::min(static_cast<std::size_t>(count), kMostErrors - errors_.size()));
    last_sign_ = Clock::now();
  }
  if (count == 0) said_.close();  // the program closed it
}

}  // namespace dspm
