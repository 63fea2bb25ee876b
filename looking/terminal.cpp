#include "dspm/looking/terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace dspm {
namespace {

constexpr std::chrono::milliseconds kPatience{400};

/// Turns off echo, and lets bytes be read as they come.
class RawInput {
 public:
  explicit RawInput(int descriptor) : descriptor_(descriptor), good_(tcgetattr(descriptor, &before_) == 0) {
    if (!good_) return;
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    raw.c_cc[VMIN] = 0, raw.c_cc[VTIME] = 0;
    good_ = tcsetattr(descriptor, TCSANOW, &raw) == 0;
  }
  ~RawInput() {
    if (good_) tcsetattr(descriptor_, TCSANOW, &before_);
  }
  RawInput(const RawInput&) = delete;
  RawInput& operator=(const RawInput&) = delete;
  explicit operator bool() const { return good_; }

 private:
  int descriptor_;
  termios before_{};
  bool good_;
};

/// Returns where the attributes begin in an answer, after "ESC [ ?"; npos if they have not come.
std::size_t attributes_in(std::string_view answer) {
  const std::size_t begin = answer.find("\x1b[?");
  return begin == answer.npos || answer.find('c', begin) == answer.npos ? answer.npos : begin + 3;
}

/// Returns what the terminal says until it has told its attributes, which are asked for last, or has kept silent for
/// too long.
std::string answer_to(std::string_view query, int descriptor) {
  std::string answer;
  if (write(descriptor, query.data(), query.size()) < 0) return answer;
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (attributes_in(answer) == answer.npos) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd one{descriptor, POLLIN, 0};
    std::array<char, 256> bytes;
    if (left.count() <= 0 || poll(&one, 1, static_cast<int>(left.count())) <= 0) break;
    const ssize_t count = read(descriptor, bytes.data(), bytes.size());
    if (count <= 0) break;
    answer.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return answer;
}

}  // namespace

Graphics graphics_of_answer(std::string_view answer) {
  if (answer.find("\x1b_Gi=31;OK") != answer.npos) return Graphics::kitty;
  const std::size_t begin = attributes_in(answer);
  if (begin == answer.npos) return Graphics::none;
  const std::string attributes = fmt::format(";{};", answer.substr(begin, answer.find('c', begin) - begin));
  // The first one is the kind of terminal.
  return attributes.find(";4;", attributes.find(';', 1)) != attributes.npos ? Graphics::sixel : Graphics::none;
}

std::string_view graphics_query(std::string_view term) {
  constexpr std::string_view kAttributes = "\x1b[c", kBoth = "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\r\x1b[K\x1b[c";
  return term.starts_with("tmux") || term.starts_with("screen") ? kAttributes : kBoth;
}

TerminalGraphics sixels_of_answer(std::string_view answer) {
  TerminalGraphics sixels{Graphics::sixel};
  constexpr std::string_view kSuccess = "\x1b[?2;0;";
  const std::size_t begin = answer.find(kSuccess);
  if (begin == answer.npos) return sixels;
  int width = 0, height = 0;
  const std::string numbers(answer.substr(begin + kSuccess.size()));
  if (std::sscanf(numbers.c_str(), "%d;%dS", &width, &height) == 2 && width > 0 && height > 0)
    sixels.max_width = width, sixels.max_height = height;
  return sixels;
}

TerminalGraphics ask_for_graphics(int descriptor, std::string_view term) {
  if (isatty(descriptor) == 0) return {};
  if (tcgetpgrp(descriptor) != getpgrp()) return {};  // in the background it would be stopped
  const RawInput raw(descriptor);
  if (!raw) return {};
  const Graphics kind = graphics_of_answer(answer_to(graphics_query(term), descriptor));
  return kind == Graphics::sixel ? sixels_of_answer(answer_to(kSixelsQuery, descriptor)) : TerminalGraphics{kind};
}

TerminalGraphics graphics_of_standard_error() {
  if (isatty(STDERR_FILENO) == 0) return {};
  const int terminal =
      open("/dev/tty", O_RDWR | O_CLOEXEC | O_NOCTTY);  // answers come here, whatever standard input is
  if (terminal < 0) return {};
  const char* const kind = std::getenv("TERM");
  const TerminalGraphics graphics = ask_for_graphics(terminal, kind == nullptr ? "" : kind);
  close(terminal);
  return graphics;
}

TerminalSize size_of_terminal(int descriptor) {
  TerminalSize size;
  winsize window{};
  if (ioctl(descriptor, TIOCGWINSZ, &window) != 0 || window.ws_col == 0 || window.ws_row == 0) return size;
  size.columns = window.ws_col, size.rows = window.ws_row;
  if (window.ws_xpixel > 0) size.cell_width = window.ws_xpixel / window.ws_col;
  if (window.ws_ypixel > 0) size.cell_height = window.ws_ypixel / window.ws_row;
  return size;
}

}  // namespace dspm
