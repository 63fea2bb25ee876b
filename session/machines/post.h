// The thread that sends and receives letters while others render.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "dspm/session/machines/link.h"

namespace dspm {

class Post {
 public:
  /// Calls `open` for each letter that arrives, on the thread of the post: it may send, but must not wait.
  Post(Link& link, std::function<void(Letter)> open);
  /// Waits until all letters are gone.
  ~Post();
  Post(const Post&) = delete;
  Post& operator=(const Post&) = delete;

  void send(int machine, LetterKind kind, std::string text = {});
  /// From now on no letter is waited for: see Link::abandon.
  void abandon() { abandoned_ = true; }
  /// The bytes of all letters so far, both ways.
  std::uint64_t bytes() const { return bytes_; }

 private:
  void run();

  Link& link_;
  std::function<void(Letter)> open_;
  std::mutex mutex_;
  std::deque<Letter> out_;
  std::atomic<bool> closing_ = false, abandoned_ = false;
  std::atomic<std::uint64_t> bytes_ = 0;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace dspm
