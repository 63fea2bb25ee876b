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
  /// The most rendered blocks that a machine holds; then it waits until one has been fetched.
  static constexpr int kMostHeld = 2;
  /// The most blocks that are on their way or here before it is their turn, besides those of the machine itself.
  static constexpr int kAhead = 2;

  /// Starts blocks of `size` iterations at iteration `begin`, up to `all` iterations; 0 means endless. Forgets
  /// everything from before.
  void open(int begin, int all, int size);
  /// Hands out no block until open() is called again.
  void close() { open_ = false; }

  /// Returns the next block for a machine; nullopt if there is none now. A machine that holds kMostHeld blocks is
  /// faster than the one that is still rendering the block whose turn it is, so it gets that block as well.
  std::optional<Block> hand_out(int machine);
  /// All blocks that begin earlier have been taken.
  int wanted_from() const { return blocks_.empty() ? next_ : blocks_.begin()->first; }
  /// The machine holds the block from now on.
  void rendered(int machine, int begin);
  /// A machine that must send a block now. to_fetch() returns each fetch once, in the order of the blocks' turns, and
  /// some of them a little before their turn, so that the blocks are here in time.
  struct Fetch {
    int machine, begin;
  };
  std::vector<Fetch> to_fetch();
  void arrived(int begin, std::string state);
  bool is_here(int begin) const;
  /// Returns the block's state, if it has arrived; then it is the next block's turn.
  std::optional<std::string> take(int begin);

 private:
  static constexpr int kNobody = -1;
  struct Entry {
    Block block;
    int machine, other = kNobody;  // the machines that render it; once it is rendered, `machine` has it
    bool is_rendered = false, is_fetched = false;
    std::optional<std::string> state = {};
  };

  std::optional<Block> once_more(int machine);

  bool open_ = false;
  int all_ = 0, size_ = 1, next_ = 0;  // iterations
  std::map<int, Entry> blocks_;        // by their beginning: those that were handed out and not yet taken
};

}  // namespace dspm
