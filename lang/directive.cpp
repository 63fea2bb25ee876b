#include "dspm/lang/directive.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/math/moments.h"
#include "dspm/lang/old_pbrt.h"

namespace dspm {
namespace {

using Kind = Token::Kind;

/// Shortens a word for messages: hostile files may have words of megabytes.
std::string shortened(std::string_view word) {
  return word.size() <= 40 ? std::string(word) : std::string(word.substr(0, 37)) + "...";
}

[[noreturn]] void fail_unknown(const Lexer& lexer, const Token& token) {
  if (token.kind != Kind::word)
    lexer.fail(token.text, fmt::format("expected a directive, not {}", shortened(token.text)));
  const std::string message = fmt::format("unknown directive {}", shortened(token.text));
  if (is_old_directive(token.text))
    throw SyntaxError(lexer.locate(token.text), message, "pbrt-v4 no longer has this directive",
                      std::string(token.text));
  lexer.fail(token.text, message, did_you_mean(token.text, directive_names()));
}

void expect_number(Lexer& lexer, const Token& word, const Directive& directive) {
  const Token& next = lexer.peek();
  const bool is_bare = next.kind == Kind::number || next.kind == Kind::word;
  if (!is_bare || find_directive(next.text) != nullptr) {
    const auto count = [&](char kind) {
      return std::count(directive.info->arguments.begin(), directive.info->arguments.end(), kind);
    };
    const auto expected = count('n') + count('k') + 3 * count('a');
    lexer.fail(word.text,
               fmt::format("{} takes {} number{}, but {} follow{}", word.text, expected, expected == 1 ? "" : "s",
                           directive.numbers.size(), directive.numbers.size() == 1 ? "s" : ""));
  }
}

void read_number(Lexer& lexer, const Token& word, Directive& directive) {
  expect_number(lexer, word, directive);
  directive.numbers.push_back(lexer.number<double>());
}

/// The time of a key, as a number of a frame.
void read_key(Lexer& lexer, const Token& word, const Clock& clock, Directive& directive) {
  expect_number(lexer, word, directive);
  const Token token = lexer.next();
  const std::optional<Moment> moment = clock.moment_of(lexer, token.text, token.text);
  if (!moment)
    lexer.fail(token.text,
               fmt::format("expected a frame from {} to {}, or seconds, such as 1.5s", clock.lowest(), kLastFrame));
  directive.numbers.push_back(moment->frames() + 1);
}

/// Three numbers, or the name of something that moves.
void read_point(Lexer& lexer, const Token& word, Directive& directive) {
  const bool is_named = lexer.peek().kind == Kind::string;
  const Token token = lexer.peek();
  directive.words.push_back({is_named ? lexer.unquoted(lexer.next()) : "", lexer.locate(token.text)});
  for (int i = 0; i < 3; ++i)
    if (is_named)
      directive.numbers.push_back(0);
    else
      read_number(lexer, word, directive);
  if (is_named && directive.words.back().text.empty()) lexer.fail(token.text, "a name is missing between the quotes");
}

void read_matrix(Lexer& lexer, const Token& word, Directive& directive) {
  if (lexer.peek().kind != Kind::open) lexer.fail(word.text, fmt::format("{} takes 16 numbers in brackets", word.text));
  const Token open = lexer.next();
  lexer.numbers_to_bracket(directive.numbers);
  if (directive.numbers.size() != 16)
    lexer.fail(open.text,
               fmt::format("{} takes 16 numbers, but this list has {}", word.text, directive.numbers.size()));
}

void read_word(Lexer& lexer, const Token& word, char kind, Directive& directive) {
  const Token& next = lexer.peek();
  const bool is_string = next.kind == Kind::string;
  if (kind == 'S' && !is_string) return;
  if ((kind == 's' || kind == 'S') && !is_string)
    lexer.fail(word.text, fmt::format("{} must be followed by a name in quotes", word.text));
  if (!is_string && next.kind != Kind::word && next.kind != Kind::number)
    lexer.fail(word.text, fmt::format("{} must be followed by a value", word.text));
  const Token token = lexer.next();
  directive.words.push_back({is_string ? lexer.unquoted(token) : std::string(token.text), lexer.locate(token.text)});
}

void expect_end(Lexer& lexer, const Directive& directive) {
  const Token& next = lexer.peek();
  if (next.kind == Kind::word || next.kind == Kind::end) return;
  if (directive.params.params.empty())
    lexer.fail(next.text, fmt::format("{} does not take {} here", directive.info->name, shortened(next.text)));
  lexer.fail(next.text, fmt::format("expected a parameter or a directive, not {}", shortened(next.text)),
             next.kind == Kind::number ? "put several numbers in brackets" : "");
}

}  // namespace

std::optional<Directive> read_directive(Lexer& lexer, OldTypes old_types, const Clock& clock) {
  const Token word = lexer.next();
  if (word.kind == Kind::end) return std::nullopt;
  Directive directive;
  directive.info = find_directive(word.text);
  if (directive.info == nullptr) fail_unknown(lexer, word);
  directive.where = lexer.locate(word.text);
  for (const char argument : directive.info->arguments) {
    switch (argument) {
      case 'n': read_number(lexer, word, directive); break;
      case 'k': read_key(lexer, word, clock, directive); break;
      case 'a': read_point(lexer, word, directive); break;
      case 'm': read_matrix(lexer, word, directive); break;
      case 'P': directive.params = read_params(lexer, old_types, clock); break;
      default: read_word(lexer, word, argument, directive); break;
    }
  }
  expect_end(lexer, directive);
  return directive;
}

}  // namespace dspm
