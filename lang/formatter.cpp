#include "dspm/lang/formatter.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "dspm/lang/directives.h"
#include "dspm/lang/lexer.h"
#include "dspm/lang/param_grammar.h"

namespace dspm {
namespace {

using Kind = Token::Kind;

constexpr std::size_t kWidth = 100;
constexpr std::size_t kIndent = 2;
constexpr std::size_t kMostLevels = 40;  // deeper blocks are not indented further: the text must not grow quadratically

struct SpacedToken : Token {
  std::size_t newlines = 0;  // between it and the previous token

  bool is_comment() const { return kind == Kind::comment; }
  bool is_comment_line() const { return is_comment() && newlines > 0; }
};
using Tokens = std::vector<SpacedToken>;

/// Tokens that stay together if a line has room: a directive's word with its arguments, one parameter, or a comment
/// line between parameters.
using Group = Tokens;

Tokens all_tokens(const SourceText& source) {
  Lexer lexer(source);
  Tokens tokens;
  const char* end_of_last = source.text().data();
  for (Token token = lexer.next_or_comment(); token.kind != Kind::end; token = lexer.next_or_comment()) {
    const auto newlines = std::count(end_of_last, token.text.data(), '\n');
    tokens.push_back({token, static_cast<std::size_t>(newlines)});
    end_of_last = token.text.data() + token.text.size();
  }
  return tokens;
}

bool starts_directive(const Token& token) {
  return token.kind == Kind::word && token.text.front() >= 'A' && token.text.front() <= 'Z';
}

/// Splits a directive off the tokens from `at` on.
class DirectiveTokens {
 public:
  DirectiveTokens(const Tokens& tokens, std::size_t at)
      : tokens_(tokens), at_(at), info_(find_directive(tokens[at].text)) {
    take_head();
    while (at_ < tokens_.size() && !ends_here()) take_group();
    if (groups_.back().back().is_comment() && !groups_.back().back().is_comment_line()) {
      trailing_comment_ = groups_.back().back().text;
      groups_.back().pop_back();
    }
  }

  const DirectiveInfo* info() const { return info_; }
  const std::vector<Group>& groups() const { return groups_; }
  std::string_view trailing_comment() const { return trailing_comment_; }
  std::size_t end() const { return at_; }

 private:
  /// Returns whether the next directive begins here, or the comment lines before it.
  bool ends_here() const {
    std::size_t next = at_;
    while (next < tokens_.size() && tokens_[next].is_comment_line()) ++next;
    return next == tokens_.size() || starts_directive(tokens_[next]);
  }

  void take() { groups_.back().push_back(tokens_[at_++]); }

  void take_comments() {
    while (at_ < tokens_.size() && tokens_[at_].is_comment()) take();
  }

  /// Takes one value or bracketed list, and the comments before and in it.
  void take_value() {
    if (ends_here()) return;
    take_comments();
    if (at_ == tokens_.size()) return;
    const bool is_list = tokens_[at_].kind == Kind::open;
    take();
    while (is_list && at_ < tokens_.size() && groups_.back().back().kind != Kind::close &&
           !starts_directive(tokens_[at_]))
      take();
  }

  void take_trailing_comment() {
    if (at_ < tokens_.size() && tokens_[at_].is_comment() && !tokens_[at_].is_comment_line()) take();
  }

  void take_head() {
    groups_.emplace_back();
    take();
    for (const char argument : info_ == nullptr ? std::string_view() : info_->arguments) {
      const bool is_missing = at_ == tokens_.size() || (argument == 'S' && tokens_[at_].kind != Kind::string);
      if (argument == 'P' || is_missing) break;
      if (argument == 'w' || argument == 'v')
        take();  // a bare word may look like a directive
      else
        take_value();
      for (int more = argument == 'a' && groups_.back().back().kind != Kind::string ? 2 : 0; more > 0; --more)
        take_value();
    }
    take_trailing_comment();
  }

  void take_group() {
    groups_.emplace_back();
    const bool is_param = declares_param(tokens_[at_].text), is_comment = tokens_[at_].is_comment();
    if (is_comment || is_param)
      take();
    else
      take_value();
    if (is_param) take_value();
    if (!is_comment) take_trailing_comment();
  }

  const Tokens& tokens_;
  std::size_t at_;
  const DirectiveInfo* info_;
  std::vector<Group> groups_;
  std::string_view trailing_comment_;
};

/// Removes brackets around a single value: they mean nothing, unless its $name stands for several. Misplaced ones
/// inside a list stay.
Group without_needless_brackets(Group group) {
  const std::size_t n = group.size();
  const auto first_open = std::find_if(group.begin(), group.end(), [](const Token& t) { return t.kind == Kind::open; });
  const bool is_needless = n >= 4 && first_open == group.end() - 3 && group[n - 1].kind == Kind::close &&
                           group[n - 2].kind != Kind::open && !group[n - 2].is_comment() &&
                           group[n - 4].kind == Kind::string &&
                           (group[n - 2].kind == Kind::string || group[n - 2].text.find('$') == std::string_view::npos);
  if (is_needless) group.erase(group.end() - 1), group.erase(group.end() - 2);
  return group;
}

bool joins(const Token& before, const Token& token) { return before.kind == Kind::open || token.kind == Kind::close; }

class Writer {
 public:
  std::string take() { return std::move(text_); }

  void write(const Tokens& tokens) {
    for (std::size_t at = 0; at < tokens.size();) {
      if (tokens[at].newlines > 1 && !text_.empty()) text_ += '\n';
      if (tokens[at].is_comment()) {
        write_comment(tokens[at]);
        ++at;
      } else {
        const DirectiveTokens directive(tokens, at);
        write(directive);
        at = std::max(directive.end(), at + 1);
      }
    }
  }

 private:
  std::size_t indent() const { return std::min(level_, kMostLevels) * kIndent; }

  void write_comment(const SpacedToken& comment) {
    const bool follows_code = comment.newlines == 0 && !text_.empty();
    if (follows_code) text_.pop_back();  // the newline
    text_ += follows_code ? "  " : std::string(indent(), ' ');
    text_.append(comment.text) += '\n';
  }

  void write(const DirectiveTokens& directive) {
    const int change = directive.info() == nullptr ? 0 : directive.info()->indentation;
    const bool is_key = directive.info() != nullptr && directive.info()->kind == DirectiveKind::keyframe;
    const bool ends_keys =
        change < 0 || (directive.info() != nullptr && directive.info()->kind == DirectiveKind::keyframe_end);
    if (in_key_ && (is_key || ends_keys)) --level_;
    in_key_ = is_key || (in_key_ && !ends_keys);
    if (change < 0 && level_ > 0) --level_;
    write_groups(directive.groups());
    if (!directive.trailing_comment().empty()) text_.append("  ").append(directive.trailing_comment());
    text_ += '\n';
    if (change > 0 || is_key) ++level_;
  }

  void write_groups(const std::vector<Group>& given) {
    std::vector<Group> groups;
    for (const Group& group : given) groups.push_back(without_needless_brackets(group));
    const bool fits = one_line_width(groups) <= kWidth;
    column_ = 0;
    start_line(indent());
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const bool new_line = i > 0 && (!fits || groups[i].front().is_comment_line());
      if (new_line) break_line(indent() + 2 * kIndent);
      if (i > 0 && !new_line) write_text(" ");
      write_group(groups[i]);
    }
  }

  std::size_t one_line_width(const std::vector<Group>& groups) const {
    std::size_t width = indent();
    for (const Group& group : groups)
      for (const SpacedToken& token : group) width += token.is_comment() ? kWidth + 1 : token.text.size() + 1;
    return width - 1;
  }

  void write_group(const Group& group) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      const SpacedToken& token = group[i];
      const bool after_comment = i > 0 && group[i - 1].is_comment();
      if (i > 0 && (after_comment || token.is_comment_line() || !fits(group, i)))
        break_line(indent() + 3 * kIndent);
      else if (i > 0 && !joins(group[i - 1], token))
        write_text(token.is_comment() ? "  " : " ");
      write_text(token.text);
    }
  }

  /// Returns whether a token fits on the line. A closing bracket must fit on the line of the last value: breaking
  /// before one gains nothing.
  bool fits(const Group& group, std::size_t i) const {
    if (group[i].is_comment() || joins(group[i - 1], group[i])) return true;
    const bool closes_next = i + 1 < group.size() && group[i + 1].kind == Kind::close;
    return column_ + 1 + group[i].text.size() + (closes_next ? 1 : 0) <= kWidth;
  }

  void start_line(std::size_t indent) {
    text_.append(indent, ' ');
    column_ = indent;
  }

  void break_line(std::size_t indent) {
    text_ += '\n';
    start_line(indent);
  }

  void write_text(std::string_view text) {
    text_ += text;
    column_ += text.size();
  }

  std::string text_;
  std::size_t column_ = 0, level_ = 0;
  bool in_key_ = false;  // after a Keyframe, one level in
};

}  // namespace

std::optional<std::string> format_scene(const SourceFile& file, Diagnostics& diagnostics) {
  try {
    const SourceText source(file);
    Writer writer;
    writer.write(all_tokens(source));
    return writer.take();
  } catch (const SyntaxError& error) {
    diagnostics.error(error.where, error.what(), error.hint);
    return std::nullopt;
  }
}

}  // namespace dspm
