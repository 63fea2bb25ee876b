// Turns text into tokens. Tokens are views of the text; lists of numbers, which make up most of a scene file, go
// straight into vectors, without tokens.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/lang/source_text.h"

namespace dspm {

struct Token {
  enum class Kind { word, number, string, open, close, comment, end };  // open and close: the brackets of a list
  Kind kind = Kind::end;
  std::string_view text;  // as written: strings with their quotes, comments from # to the end of the line
};

/// Throws SyntaxError for text that is not a token.
class Lexer {
 public:
  /// Keeps a reference to `source`.
  explicit Lexer(const SourceText& source);

  Token next();
  Token next_or_comment();
  const Token& peek();

  /// Reads one number, of type float, double or int; finite and within the type's range.
  template <class Number>
  Number number();
  /// Reads the numbers up to the closing bracket, and that bracket. The opening one has been read.
  template <class Number>
  void numbers_to_bracket(std::vector<Number>& values);
  /// Returns the text between the quotes, escapes resolved.
  std::string unquoted(const Token& string) const;

  /// Returns what has not been read, from the next token on.
  std::string_view rest();
  /// Goes on at that place of the text.
  void go_on_at(const char* place);
  /// Skips these characters and returns true, if the rest begins with them.
  bool skip(std::string_view characters);
  /// Reads the numbers that follow. Returns false if one of them is not written as numbers usually are: read it as
  /// tokens then.
  bool plain_numbers(std::vector<float>& values);

  /// Skips to the next word that could be a directive, to recover from an error.
  void skip_to_directive();

  SourceLocation locate(std::string_view piece) const { return source_.locate(piece); }
  /// Fails if the word has a no-break space, a typographic quote or the like.
  void refuse_lookalikes(std::string_view word) const;
  [[noreturn]] void fail(std::string_view piece, const std::string& message, std::string hint = {}) const;

 private:
  void skip_blank();
  void take_back_peeked();
  std::string_view word_at(const char* begin) const;
  Token read_string();
  template <class Number>
  Number read_number();
  template <class Number>
  [[noreturn]] void fail_number(std::string_view word) const;

  const SourceText& source_;
  const char* at_;
  const char* end_;
  std::optional<Token> peeked_;
};

}  // namespace dspm
