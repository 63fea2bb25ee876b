// The open blocks of a scene's text: AttributeBegin, DynamicBegin, VariationBegin, an imported file, ...
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/lang/graphics_state.h"

namespace dspm {

/// A block of the text, with the state to restore after it.
struct Block {
  enum class Kind { attribute, transform, dynamic, object, axis, variation, import };
  Kind kind;
  std::string name;  // empty if the kind has none
  SourceLocation where;
  GraphicsState outer;
  bool has_keys = false;  // one group of Keyframes per block
};

/// Returns `DynamicBegin "horse"`, or `DynamicEnd` as its end.
std::string begin_of(const Block& block);
std::string_view end_of(Block::Kind kind);
/// Returns "line 12", or "file:12" if the file is not that of `seen_from`.
std::string place_of(const SourceLocation& where, const SourceLocation& seen_from);

/// The open blocks, innermost last; reports errors in their nesting.
class BlockStack {
 public:
  explicit BlockStack(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// Throws SyntaxError beyond a thousand levels.
  void open(Block block);
  /// Closes the innermost block of that kind and, after an error, those inside it. Returns the state before it, or
  /// `current` if there is nothing to restore.
  GraphicsState close(Block::Kind kind, const SourceLocation& where, const GraphicsState& current);
  /// Closes the innermost imported file; blocks that it left open are errors.
  GraphicsState close_import();
  /// Reports every open block as an error.
  void check_all_closed() const;

  bool empty() const { return blocks_.empty(); }
  Block& innermost() { return blocks_.back(); }
  bool innermost_is(Block::Kind kind) const { return !blocks_.empty() && blocks_.back().kind == kind; }
  /// Returns the innermost block of that kind, or null.
  const Block* find(Block::Kind kind) const;
  /// Returns the innermost block of none of these kinds, or null.
  const Block* find_other(std::initializer_list<Block::Kind> kinds) const;

 private:
  void report_open(const Block& block) const;

  Diagnostics& diagnostics_;
  std::vector<Block> blocks_;
};

}  // namespace dspm
