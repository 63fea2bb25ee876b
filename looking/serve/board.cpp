#include "dspm/looking/serve/board.h"

#include <utility>

namespace dspm {

void Board::set_state(std::string json) {
  const std::lock_guard lock(mutex_);
  if (json == state_) return;
  state_ = std::move(json), ++version_;
  changed_.notify_all();
}

void Board::set_problem(std::string text) {
  const std::lock_guard lock(mutex_);
  if (text == problem_) return;
  problem_ = std::move(text), ++version_;
  changed_.notify_all();
}

void Board::add_line(std::string text) {
  const std::lock_guard lock(mutex_);
  lines_.push_back({++last_line_, std::move(text)});
  if (lines_.size() > kLines) lines_.pop_front();
  changed_.notify_all();
}

Board::News Board::after(std::uint64_t version, std::uint64_t line, std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [&] { return closed_ || version_ != version || last_line_ > line; });
  News news;
  news.version = version_, news.closed = closed_;
  if (version_ != version) news.state = state_, news.problem = problem_;
  for (const Line& each : lines_)
    if (each.number > line) news.lines.push_back(each);
  return news;
}

void Board::set_run(std::string json) {
  const std::lock_guard lock(mutex_);
  run_ = std::move(json);
}

std::string Board::run() const {
  const std::lock_guard lock(mutex_);
  return run_;
}

void Board::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

}  // namespace dspm
