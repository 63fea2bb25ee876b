#include "dspm/lang/upgrade.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "dspm/lang/directive.h"
#include "dspm/lang/formatter.h"
#include "dspm/lang/lexer.h"
#include "dspm/lang/old_pbrt.h"
#include "dspm/lang/v3/translator.h"
#include "dspm/lang/write_directive.h"

namespace dspm {
namespace {

/// A place between tokens, with what was between it and the token before it.
struct Place {
  const char* at;
  bool after_code, after_blank_line;  // on its line; above it
};

struct Comment : Place {
  std::string_view text;
};

Place place_of(std::string_view token, std::string_view text) {
  const char* begin = token.data();
  while (begin != text.data() && std::string_view(" \t\r\n").find(begin[-1]) != std::string_view::npos) --begin;
  const auto newlines = std::count(begin, token.data(), '\n');
  return {token.data(), newlines == 0 && begin != text.data(), newlines > 1 && begin != text.data()};
}

std::vector<Comment> comments_of(const SourceText& source) {
  std::vector<Comment> comments;
  Lexer lexer(source);
  for (Token token = lexer.next_or_comment(); token.kind != Token::Kind::end; token = lexer.next_or_comment())
    if (token.kind == Token::Kind::comment) comments.push_back({place_of(token.text, source.text()), token.text});
  return comments;
}

class Upgrade {
 public:
  Upgrade(const SourceText& source, Diagnostics& diagnostics) : source_(source), diagnostics_(diagnostics) {}

  std::string text() {
    read();
    std::string text;
    auto comment = comments_.begin();
    const auto write_comments = [&](const char* before) {
      for (; comment != comments_.end() && comment->at < before; ++comment) write(*comment, text);
    };
    for (std::size_t i = 0; i < places_.size(); ++i) {
      write_comments(places_[i].at);
      if (places_[i].after_blank_line) text += '\n';
      for (const Directive& directive : translated_[i]) text += text_of(directive) + '\n';
      is_after_comment_ = false;
    }
    write_comments(source_.text().data() + source_.text().size());
    return text;
  }

  std::string summary() const { return translator_.summary(); }
  bool includes_others() const { return includes_others_; }

 private:
  void read() {
    Lexer lexer(source_);
    while (lexer.peek().kind != Token::Kind::end) {
      const Place place = place_of(lexer.peek().text, source_.text());
      try {
        add(place, *read_directive(lexer, OldTypes::v3));
      } catch (const SyntaxError& error) {
        if (error.old_word == "WorldEnd") continue;
        if (!error.old_word.empty()) throw old_pbrt_error({error.old_word, error.where});
        diagnostics_.error(error.where, error.what(), error.hint);
        lexer.skip_to_directive();
      }
    }
  }

  void add(const Place& place, Directive directive) {
    if (is_certainly_new(directive))
      throw SyntaxError(directive.where, "this scene is not for pbrt-v3, so there is nothing to upgrade");
    if (const auto word = old_word_in(directive); word && is_before_v3(*word)) throw old_pbrt_error(*word);
    const DirectiveKind kind = directive.info->kind;
    includes_others_ = includes_others_ || kind == DirectiveKind::include || kind == DirectiveKind::import;
    places_.push_back(place);
    try {
      translated_.push_back(translator_.translate(std::move(directive)));
    } catch (v3::NoCounterpart& error) {
      diagnostics_.unsupported(error.where, error.what(), error.hint);
      translated_.push_back(std::move(error.instead));
    }
    if (kind == DirectiveKind::world_begin && !std::exchange(is_world_, true)) translator_.settle(translated_);
  }

  /// Writes a comment after the directive on its line, if no other comment is there.
  void write(const Comment& comment, std::string& text) {
    const bool joins = comment.after_code && !is_after_comment_ && !text.empty();
    if (joins) text.pop_back();  // the newline
    if (comment.after_blank_line) text += '\n';
    (text += joins ? "  " : "").append(comment.text) += '\n';
    is_after_comment_ = true;
  }

  const SourceText& source_;
  Diagnostics& diagnostics_;
  v3::Translator translator_;
  std::vector<Comment> comments_ = comments_of(source_);
  std::vector<Place> places_;
  v3::Header translated_;  // by place
  bool is_world_ = false, is_after_comment_ = false, includes_others_ = false;
};

}  // namespace

std::optional<std::string> upgrade_scene(const SourceFile& file, Diagnostics& diagnostics) {
  try {
    const int errors = diagnostics.error_count();
    const SourceText source(file);
    Upgrade upgrade(source, diagnostics);
    const std::string text = upgrade.text();
    if (diagnostics.error_count() > errors) return std::nullopt;
    diagnostics.note({&file}, upgrade.summary());
    if (upgrade.includes_others()) diagnostics.note({&file}, "the files that it includes need --upgrade, too");
    return format_scene({file.name, text}, diagnostics);
  } catch (const SyntaxError& error) {
    diagnostics.error(error.where, error.what(), error.hint);
    return std::nullopt;
  }
}

}  // namespace dspm
