#include "dspm/looking/terminal.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>

namespace dspm {
namespace {

constexpr std::chrono::milliseconds kPatience{400};

/// Without echo, and read as the bytes come.
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

/// Where the attributes begin in an answer, after "ESC [ ?"; npos: they have not come.
std::size_t attributes_in(std::string_view answer) {
  const std::size_t begin = answer.find("\x1b[?");
  return begin == answer.npos || answer.find('c', begin) == answer.npos ? answer.npos : begin + 3;
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

Graphics ask_for_graphics(int descriptor) {
  if (isatty(descriptor) == 0) return Graphics::none;
  if (tcgetpgrp(descriptor) != getpgrp()) return Graphics::none;  // in the background it would be stopped
  const RawInput raw(descriptor);
  if (!raw || write(descriptor, kGraphicsQuery.data(), kGraphicsQuery.size()) < 0) return Graphics::none;
  std::string answer;
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
  return graphics_of_answer(answer);
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
