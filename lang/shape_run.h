// Shape directives that repeat the one before them except for numbers: the strands of hair, of which files have
// millions. They are read without tokens, and kept as numbers and places in the text. Whatever repeats it less exactly
// is read as any directive is, so no message depends on this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/lang/description.h"
#include "dspm/lang/lexer.h"
#include "dspm/lang/source_text.h"

namespace dspm {

class ShapeRun {
 public:
  /// Begins a run after `first`, which was read from `words`, a view into the text, with the blanks and comments that
  /// follow it. Returns nullopt if it has no lists of numbers that may differ.
  static std::optional<ShapeRun> after(const ShapeUse& first, std::shared_ptr<const SourceText> source,
                                       std::string_view words);

  /// Reads the directives that begin at `at`, as long as they repeat the first; returns where the next one begins.
  const char* read(const char* at);

  std::size_t count() const { return places_.size(); }
  /// Sets the numbers of directive i in `params`, which are those of the first, or of any other.
  void set_numbers(std::size_t i, ParamList& params) const;
  /// Returns directive i as if it had been read like any other, with the places of all that it says.
  ShapeUse at(std::size_t i, const ShapeUse& first) const;

 private:
  /// Text that all directives have in common, up to a list of numbers.
  struct Piece {
    std::string_view text;
    std::size_t param;      // the parameter whose numbers follow, in the list of the first
    std::size_t dimension;  // their count is a multiple of it
    bool is_bare;           // one number without brackets
  };

  explicit ShapeRun(std::shared_ptr<const SourceText> source) : source_(std::move(source)) {}
  bool take_pieces(const ShapeUse& first, std::string_view words);
  bool read_one(Lexer& lexer);
  void forget_after(std::size_t directives);

  std::shared_ptr<const SourceText> source_;
  std::vector<Piece> pieces_;
  std::string_view tail_;              // after the last list
  std::vector<std::size_t> declared_;  // by parameter of the first: in which of a directive's quoted strings
  std::vector<std::size_t> places_;    // of the directives, in the text
  std::vector<float> numbers_;         // of one directive after the other
  std::vector<std::uint32_t> ends_;    // of each list, in numbers_
};

/// Counts the directives, including those of runs.
std::size_t count_directives(const std::vector<ShapeUse>& shapes);

/// Calls fn(const ShapeUse&) for each directive, including those of runs.
template <class Fn>
void for_each_directive(const std::vector<ShapeUse>& shapes, const Fn& fn) {
  for (const ShapeUse& use : shapes) {
    fn(use);
    for (std::size_t i = 0; use.run != nullptr && i < use.run->count(); ++i) fn(use.run->at(i, use));
  }
}

}  // namespace dspm
