// The blocks of a scene's text that are open: AttributeBegin, DynamicBegin, VariationBegin, an imported file, ...
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/lang/graphics_state.h"

namespace dspm {

/// A block of the text, with what will be in force again behind it.
struct Block {
  enum class Kind { attribute, transform, dynamic, object, axis, variation, import };
  Kind kind;
  std::string name;  // empty where the kind has none
  SourceLocation where;
  GraphicsState outer;
  bool has_keys = false;  // one group of Keyframes a block
};

/// `DynamicBegin "horse"`, and what ends it: `DynamicEnd`.
std::string begin_of(const Block& block);
std::string_view end_of(Block::Kind kind);
/// "line 12", with the file where it is another one than that of `seen_from`.
std::string place_of(const SourceLocation& where, const SourceLocation& seen_from);

/// The blocks that are open, innermost last; says what is wrong with their nesting.
class BlockStack {
 public:
  explicit BlockStack(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// Throws SyntaxError beyond a thousand levels.
  void open(Block block);
  /// Closes the innermost block of that kind, and after an error those inside it; yields what was in force before it.
  /// Nothing to restore: `current`.
  GraphicsState close(Block::Kind kind, const SourceLocation& where, const GraphicsState& current);
  /// Closes the innermost imported file; blocks that it left open are errors.
  GraphicsState close_import();
  /// Every block that is open is an error.
  void check_all_closed() const;

  bool empty() const { return blocks_.empty(); }
  Block& innermost() { return blocks_.back(); }
  bool innermost_is(Block::Kind kind) const { return !blocks_.empty() && blocks_.back().kind == kind; }
  /// The innermost block of that kind, or null.
  const Block* find(Block::Kind kind) const;
  /// The innermost block of none of these kinds, or null.
  const Block* find_other(std::initializer_list<Block::Kind> kinds) const;

 private:
  void report_open(const Block& block) const;

  Diagnostics& diagnostics_;
  std::vector<Block> blocks_;
};

}  // namespace dspm
