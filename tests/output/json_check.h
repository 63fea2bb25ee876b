// Is a text JSON? [RFC 8259], without looking into numbers or escapes closely.
#pragma once

#include <cctype>
#include <string_view>

namespace dspm::test {

class JsonCheck {
 public:
  static bool valid(std::string_view text) {
    JsonCheck check{text};
    return check.value() && (check.space(), check.rest_.empty());
  }

 private:
  explicit JsonCheck(std::string_view text) : rest_(text) {}

  void space() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front()))) rest_.remove_prefix(1);
  }
  bool take(std::string_view word) {
    space();
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  bool text() {
    if (!take("\"")) return false;
    for (; !rest_.empty(); rest_.remove_prefix(1)) {
      if (static_cast<unsigned char>(rest_.front()) < ' ') return false;
      if (rest_.front() == '"') return take("\"");
      if (rest_.front() == '\\') rest_.remove_prefix(1);
    }
    return false;
  }
  bool number() {
    space();
    const std::size_t length = rest_.find_first_not_of("+-.0123456789eE");
    if (length == 0 || rest_.empty() || rest_.front() == '+' || rest_.front() == '.') return false;
    rest_.remove_prefix(length == rest_.npos ? rest_.size() : length);
    return true;
  }
  bool list(std::string_view end, bool keys) {
    if (take(end)) return true;
    do {
      if (keys && !(text() && take(":"))) return false;
      if (!value()) return false;
    } while (take(","));
    return take(end);
  }
  bool value() {
    if (take("{")) return list("}", true);
    if (take("[")) return list("]", false);
    return text() || take("null") || take("true") || take("false") || number();
  }

  std::string_view rest_;
};

}  // namespace dspm::test
