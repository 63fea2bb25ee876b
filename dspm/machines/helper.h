// A machine that helps: it renders the blocks that the leader orders, and keeps what comes of them until it is fetched.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "dspm/machines/post.h"
#include "dspm/session/load.h"

namespace dspm {

class Helper {
 public:
  /// `on_end` is called when the leader says that it is over, by the thread of the post.
  Helper(Link& link, std::function<void()> on_end);

  /// Until the leader says that it is over. `host`: this machine's name. `digest`: of its scene.
  void render(const LoadedScene& loaded, Messages& messages, const std::string& host, const std::string& digest);
  /// Says that it cannot help, and waits for the end.
  void fail(const std::string& why);

 private:
  void open(Letter letter);
  /// nullopt: it is over.
  std::optional<Order> next_order();

  std::function<void()> on_end_;
  std::mutex mutex_;  // of all that follows but the post
  std::condition_variable changed_;
  std::optional<Order> order_;
  bool is_over_ = false;
  std::map<Rendered, std::string> kept_;  // states
  Post post_;                             // the last member: its thread uses the others
};

}  // namespace dspm
