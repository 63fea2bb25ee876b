#include "dspm/session/machines/post.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dspm {

Post::Post(Link& link, std::function<void(Letter)> open)
    : link_(link), open_(std::move(open)), thread_([this] { run(); }) {}

Post::~Post() {
  closing_ = true;
  thread_.join();
}

void Post::send(int machine, LetterKind kind, std::string text) {
  bytes_ += text.size();
  const std::lock_guard lock(mutex_);
  out_.push_back({machine, kind, std::move(text)});
}

void Post::run() {
  // Short after a letter, as another one often follows; long enough to cost nothing if none comes.
  constexpr std::chrono::microseconds kShortest(50), kLongest(2000);
  auto rest = kShortest;
  const auto take = [&]() -> std::optional<Letter> {
    const std::lock_guard lock(mutex_);
    if (out_.empty()) return std::nullopt;
    Letter letter = std::move(out_.front());
    out_.pop_front();
    return letter;
  };
  while (!abandoned_) {
    const bool closing = closing_;  // before the last look for letters
    bool was_idle = true;
    while (std::optional<Letter> letter = take()) link_.send(std::move(*letter)), was_idle = false;
    while (std::optional<Letter> letter = link_.receive()) {
      bytes_ += letter->text.size(), was_idle = false;
      open_(std::move(*letter));
    }
    if (link_.is_quiet() && closing && was_idle) return;
    rest = was_idle ? std::min(2 * rest, kLongest) : kShortest;
    if (was_idle) std::this_thread::sleep_for(rest);
  }
  link_.abandon();
}

}  // namespace dspm
