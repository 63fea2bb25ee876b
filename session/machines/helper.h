// A machine that helps: it renders the blocks that the leader orders, and keeps the results until they are fetched.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "dspm/session/load.h"
#include "dspm/session/machines/post.h"

namespace dspm {

class Helper {
 public:
  /// Calls `on_end`, on the thread of the post, when the leader says that the render is over, or that the scene was
  /// edited.
  Helper(Link& link, std::function<void()> on_end);
  /// Says goodbye.
  ~Helper() { post_.send(0, LetterKind::bye); }

  /// Returns what to load; nullopt if the render is over.
  std::optional<Edition> edition();
  /// Renders until the leader says that the render is over, or that there is another edition.
  void render(const LoadedScene& loaded, Messages& messages, const Hello& hello);
  /// Says that it cannot help with this edition, and waits until the render is over, or there is another edition.
  void fail(const Failure& failure);

 private:
  void open(Letter letter);
  /// Returns nullopt if there are no more orders of this edition.
  std::optional<Order> next_order(int edition);

  std::function<void()> on_end_;
  std::mutex mutex_;  // of all that follows but the post
  std::condition_variable changed_;
  Edition edition_;
  std::optional<Order> order_;
  bool is_over_ = false;
  std::map<Rendered, std::string> kept_;  // states
  Post post_;                             // the last member: its thread uses the others
};

}  // namespace dspm
