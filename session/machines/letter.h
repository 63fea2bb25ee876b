// The letters that machines that render together write to one another. The first one leads: it hands out blocks of
// iterations, and adds up what comes back. The others help.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/state_in_memory.h"
#include "dspm/session/block.h"

namespace dspm {

enum class LetterKind {
  ready,   // helper: who it is, and a digest of its scene; asks for an order
  order,   // leader
  done,    // helper: its order's block is rendered; asks for the next one
  bring,   // leader: a block's turn has come
  state,   // helper: of that block
  failed,  // helper: why it cannot go on
  edited,  // leader: the scene is to be read anew
  end,     // leader: there are no more orders
  bye      // helper: its last letter
};

struct Letter {
  int machine = 0;  // the other one
  LetterKind kind = LetterKind::end;
  std::string text;
};

/// A block to render.
struct Order {
  std::uint64_t interval = 0;     // how many the run began before
  std::vector<FileFrame> frames;  // of the interval
  std::uint64_t memory = 0;       // bytes that its integrator may hold; 0: no bound
  Block block;
  int wanted_from = 0;  // blocks that begin earlier need not be kept

  void persist(StateStream& state) {
    state.value(interval);
    state.list(frames, std::size_t{1} << 24);
    state.value(memory);
    state.value(block);
    state.value(wanted_from);
  }
};

/// A block that is rendered. In a letter of the kind `state`, the state follows it.
struct Rendered {
  std::uint64_t interval = 0;
  int begin = 0;  // of the block

  void persist(StateStream& state) { state.value(interval), state.value(begin); }
  friend auto operator<=>(const Rendered&, const Rendered&) = default;
};

/// The scene to be rendered, which is edited while a page shows it.
struct Edition {
  int number = 0;                                     // of edits so far
  std::optional<std::array<double, 9>> look_at = {};  // see Choices

  void persist(StateStream& state) {
    state.value(number);
    bool is_placed = look_at.has_value();
    state.value(is_placed);
    if (!is_placed) return look_at.reset();
    if (!look_at) look_at.emplace();
    state.value(*look_at);
  }
};

/// A helper's introduction.
struct Hello {
  std::string host, digest;  // the machine's name, and what its scene is
  int edition = 0;

  void persist(StateStream& state) {
    state.text(host, 1 << 10), state.text(digest, 1 << 10);
    state.value(edition);
  }
};

struct Failure {
  int edition = 0;
  std::string why;

  void persist(StateStream& state) { state.value(edition), state.text(why, 1 << 20); }
};

/// Writes anything with persist() as the text of a letter. read() is the way back, and throws std::runtime_error if the
/// text is not one.
template <class T>
std::string written(T value) {
  return state_of(value);
}
template <class T>
T read(const std::string& text) {
  T value;
  load_state(text, value);
  return value;
}

}  // namespace dspm
