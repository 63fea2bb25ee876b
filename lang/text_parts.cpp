// Finds out where a scene's text may change the values of `$name`.
#include <algorithm>
#include <optional>

#include "dspm/lang/source_text.h"

namespace dspm {
namespace {

/// Finds words and strings without reading them.
class Scan {
 public:
  explicit Scan(std::string_view text) : text_(text) {}

  /// Returns the next word, string or single sign; empty at the end.
  std::string_view next() {
    skip_blank();
    const std::size_t begin = at_;
    if (at_ == text_.size()) return {};
    if (text_[at_] == '"')
      skip_string();
    else if (is_sign(text_[at_]))
      ++at_;
    else
      while (at_ < text_.size() && !is_blank(text_[at_]) && !is_sign(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  std::size_t at() const { return at_; }

 private:
  static bool is_sign(char c) { return c == '"' || c == '[' || c == ']' || c == '#'; }
  void skip_blank() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#'))
      at_ = text_[at_] == '#' ? std::min(text_.find('\n', at_), text_.size()) : at_ + 1;
  }
  /// Skips a string, which ends with its line at the latest.
  void skip_string() {
    for (++at_; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
      if (text_[at_] == '"') return void(++at_);
      if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
    }
    at_ = std::min(at_, text_.size());
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<TextPart> parts_of(std::string_view text) {
  std::vector<TextPart> parts;
  std::size_t begin = 0;
  if (text.find('$') != text.npos) {
    Scan scan(text);
    for (std::string_view word = scan.next(); !word.empty(); word = scan.next()) {
      if (word == "Default")
        scan.next();
      else if (word != "Include" && word != "Import")
        continue;
      scan.next();
      parts.push_back({begin, scan.at()});
      begin = scan.at();
    }
  }
  parts.push_back({begin, text.size()});
  return parts;
}

}  // namespace dspm
