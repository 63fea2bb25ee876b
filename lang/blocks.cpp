#include "dspm/lang/blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dspm/lang/source_text.h"

namespace dspm {
namespace {

constexpr std::size_t kMostBlocks = 1000;  // no scene nests so deeply; a hostile one would fill the memory

std::string_view begin_word(Block::Kind kind) {
  switch (kind) {
    case Block::Kind::attribute: return "AttributeBegin";
    case Block::Kind::transform: return "TransformBegin";
    case Block::Kind::dynamic: return "DynamicBegin";
    case Block::Kind::object: return "ObjectBegin";
    case Block::Kind::axis: return "AxisBegin";
    case Block::Kind::variation: return "VariationBegin";
    case Block::Kind::import: break;
  }
  return "Import";
}

}  // namespace

std::string place_of(const SourceLocation& where, const SourceLocation& seen_from) {
  if (where.file == seen_from.file) return fmt::format("line {}", where.line);
  return fmt::format("{}:{}", where.file->name, where.line);
}

std::string begin_of(const Block& block) {
  return fmt::format("{}{}", begin_word(block.kind), block.name.empty() ? "" : fmt::format(" \"{}\"", block.name));
}

std::string_view end_of(Block::Kind kind) {
  switch (kind) {
    case Block::Kind::attribute: return "AttributeEnd";
    case Block::Kind::transform: return "TransformEnd";
    case Block::Kind::dynamic: return "DynamicEnd";
    case Block::Kind::object: return "ObjectEnd";
    case Block::Kind::axis: return "AxisEnd";
    case Block::Kind::variation: return "VariationEnd";
    case Block::Kind::import: break;
  }
  return "the end of the imported file";
}

void BlockStack::open(Block block) {
  if (blocks_.size() == kMostBlocks)
    throw SyntaxError(block.where, fmt::format("blocks are nested more than {} deep", kMostBlocks));
  blocks_.push_back(std::move(block));
}

GraphicsState BlockStack::close(Block::Kind kind, const SourceLocation& where, const GraphicsState& current) {
  if (blocks_.empty()) {
    diagnostics_.error(where, fmt::format("{} without {}", end_of(kind), begin_word(kind)));
    return current;
  }
  if (innermost().kind != kind) {
    diagnostics_.error(where,
                       fmt::format("{} does not match {} ({})", end_of(kind), begin_of(innermost()),
                                   place_of(innermost().where, where)),
                       innermost().kind == Block::Kind::import
                           ? "an imported file cannot close blocks that were opened outside it"
                           : fmt::format("{} ends with {}", begin_word(innermost().kind), end_of(innermost().kind)));
    if (innermost().kind == Block::Kind::import) return current;
    // Either an inner block was left open or the wrong end was written: close up to a block of that kind, or only this
    // one.
    const auto barrier = std::find_if(blocks_.rbegin(), blocks_.rend(), [&](const Block& block) {
      return block.kind == kind || block.kind == Block::Kind::import;
    });
    if (barrier != blocks_.rend() && barrier->kind == kind) blocks_.erase(barrier.base(), blocks_.end());
  }
  GraphicsState outer = std::move(innermost().outer);
  blocks_.pop_back();
  return outer;
}

GraphicsState BlockStack::close_import() {
  for (; innermost().kind != Block::Kind::import; blocks_.pop_back()) report_open(innermost());
  GraphicsState outer = std::move(innermost().outer);
  blocks_.pop_back();
  return outer;
}

void BlockStack::check_all_closed() const {
  for (const Block& block : blocks_) report_open(block);
}

void BlockStack::report_open(const Block& block) const {
  diagnostics_.error(block.where, fmt::format("{} is not closed", begin_of(block)),
                     fmt::format("{} is missing", end_of(block.kind)));
}

const Block* BlockStack::find(Block::Kind kind) const {
  const auto found =
      std::find_if(blocks_.rbegin(), blocks_.rend(), [&](const Block& block) { return block.kind == kind; });
  return found == blocks_.rend() ? nullptr : &*found;
}

const Block* BlockStack::find_other(std::initializer_list<Block::Kind> kinds) const {
  const auto found = std::find_if(blocks_.rbegin(), blocks_.rend(), [&](const Block& block) {
    return std::find(kinds.begin(), kinds.end(), block.kind) == kinds.end();
  });
  return found == blocks_.rend() ? nullptr : &*found;
}

}  // namespace dspm
