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
  /// So many are on their way or here before it is their turn, besides those of the machine itself.
  static constexpr int kAhead = 2;

  /// Blocks of `size` iterations from iteration `begin` on, of `all`; 0: endless. Forgets all that was before.
  void open(int begin, int all, int size);
  /// No block is handed out until it is opened again.
  void close() { open_ = false; }

  /// The next block for a machine; nullopt: none now. A machine that holds as many as it may is the faster one by as many
  /// blocks than that which renders the block whose turn it is: it gets that block once more.
  std::optional<Block> hand_out(int machine);
  /// Blocks that begin earlier have been taken.
  int wanted_from() const { return blocks_.empty() ? next_ : blocks_.begin()->first; }
  /// The machine holds the block from now on.
  void rendered(int machine, int begin);
  /// Which machine is to bring which block now, in the order of their turns; each once. They may be a few before it is
  /// their turn, so that they are there then.
  struct Fetch {
    int machine, begin;
  };
  std::vector<Fetch> to_fetch();
  void arrived(int begin, std::string state);
  bool is_here(int begin) const;
  /// The state of the block, if it has arrived; the next one's turn has come then.
  std::optional<std::string> take(int begin);

 private:
  static constexpr int kNobody = -1;
  struct Entry {
    Block block;
    int machine, other = kNobody;  // that render it; once it is rendered, `machine` has it
    bool is_rendered = false, is_fetched = false;
    std::optional<std::string> state = {};
  };

  std::optional<Block> once_more(int machine);

  bool open_ = false;
  int all_ = 0, size_ = 1, next_ = 0;  // iterations
  std::map<int, Entry> blocks_;        // by their beginning: those that were handed out and not yet taken
};

}  // namespace dspm
