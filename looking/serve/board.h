// The board holds what the page says: the state of the run, as JSON, and the lines of the log. Threads that serve
// viewers wait for news.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace dspm {

class Board {
 public:
  struct Line {
    std::uint64_t number;
    std::string text;
  };
  struct News {
    std::uint64_t version = 0;   // of the state
    std::string state, problem;  // empty state: both as before
    std::vector<Line> lines;
    bool closed = false;
  };

  void set_state(std::string json);
  /// Says why the scene cannot be rendered; empty if it can.
  void set_problem(std::string text);
  void add_line(std::string text);
  /// Returns what came after that version of the state and that line; nothing once patience is over.
  News after(std::uint64_t version, std::uint64_t line, std::chrono::milliseconds patience);
  /// Says what the frames are, as JSON.
  void set_run(std::string json);
  std::string run() const;
  void close();

 private:
  static constexpr std::size_t kLines = 1000;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::string state_ = "{}", run_ = "{}", problem_;
  std::uint64_t version_ = 1, last_line_ = 0;
  std::deque<Line> lines_;  // the last ones
  bool closed_ = false;
};

}  // namespace dspm
