// A scene file's text as the lexer reads it: `$name` replaced by its value, and every place in it traced back
// to line and column of the original file.
#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/base/params/errors.h"

namespace dspm {

/// Returns whether the character separates words.
inline bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Returns the text from `begin` up to `end`.
inline std::string_view view(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

using Defines = std::map<std::string, std::string, std::less<>>;

/// An error at a place in the text; caught where reading can continue.
class SyntaxError : public std::runtime_error {
 public:
  SyntaxError(const SourceLocation& place, const std::string& message, std::string a_hint = {}, std::string old = {})
      : std::runtime_error(message), where(place), hint(std::move(a_hint)), old_word(std::move(old)) {}

  SourceLocation where;
  std::string hint;
  std::string old_word;  // known to older versions of pbrt, see old_pbrt.h; mostly empty
};

bool is_define_name(std::string_view name);
/// Returns whether the text contains $define.
bool refers_to(std::string_view text, std::string_view define);

/// Characters of a file, from `begin` to `end`.
struct TextPart {
  std::size_t begin = 0, end = 0;
};

/// Splits a text into parts that are each read with the defines of that time: they end after a Default, an Include or
/// an Import, which may give a name its value. A text without `$` is one part.
std::vector<TextPart> parts_of(std::string_view text);

/// A text in which `$name` is replaced. Every undefined `$name` is an error.
class SourceText {
 public:
  /// Leaves `$name` as it is.
  explicit SourceText(const SourceFile& file);
  /// Takes the characters `part` of `whole`, which leaves `$name` as it is and must outlive this text.
  SourceText(const SourceText& whole, const TextPart& part, const Defines& defines, Diagnostics& diagnostics);

  SourceText(const SourceText&) = delete;
  SourceText& operator=(const SourceText&) = delete;

  std::string_view text() const { return text_; }
  const SourceFile& file() const { return file_; }
  /// Returns the location of `piece`, a view into text().
  SourceLocation locate(std::string_view piece) const;

 private:
  struct Replacement {
    std::size_t begin, end;                    // in text()
    std::size_t original_begin, original_end;  // in the part
  };

  void replace(const Defines& defines, Diagnostics& diagnostics);
  std::size_t original(std::size_t offset, bool is_end) const;
  SourceLocation locate_original(std::size_t begin, std::size_t end) const;

  const SourceFile& file_;
  std::size_t begin_ = 0;  // in the file
  std::string replaced_;
  std::string_view text_;
  std::vector<Replacement> replacements_;
  std::shared_ptr<const std::vector<std::size_t>> line_starts_;  // of the file
};

}  // namespace dspm
