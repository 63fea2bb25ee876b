// The leader's book: which machine renders which block, and whose turn it is to be added.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dspm/session/block.h"

namespace dspm {

class Desk {
 public:
  /// A machine holds at most so many rendered blocks: then it waits until one has been fetched.
  static constexpr int kMostHeld = 2;

  /// Blocks of `size` iterations from iteration `begin` on, of `all`; 0: endless. Forgets all that was before.
  void open(int begin, int all, int size);
  /// No block is handed out until it is opened again.
  void close() { open_ = false; }

  /// The next block for a machine; nullopt: none now.
  std::optional<Block> hand_out(int machine);
  /// The machine holds the block from now on.
  void rendered(int machine, int begin);
  /// Which machine is to bring which block now, in the order of their turns; each once.
  struct Fetch {
    int machine, begin;
  };
  std::vector<Fetch> to_fetch();
  void arrived(int begin, std::string state);
  /// The state of the block, if it has arrived; the next one's turn has come then.
  std::optional<std::string> take(int begin);

 private:
  /// So many are on their way at a time.
  static constexpr int kAhead = 2;
  struct Entry {
    Block block;
    int machine;
    bool is_rendered = false, is_fetched = false;
    std::optional<std::string> state = {};
  };

  bool open_ = false;
  int all_ = 0, size_ = 1, next_ = 0;  // iterations
  std::map<int, Entry> blocks_;        // by their beginning: those that were handed out and not yet taken
};

}  // namespace dspm
