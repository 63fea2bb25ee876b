#include "dspm/shapes/obj_statements.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace dspm {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);  // npos + 1 is 0
}

}  // namespace

std::string_view ObjStatements::next_line() {
  const std::string_view line = left_.substr(0, left_.find('\n'));
  left_.remove_prefix(std::min(line.size() + 1, left_.size()));
  ++lines_;
  return line;
}

std::optional<ObjStatement> ObjStatements::next() {
  while (!left_.empty()) {
    const int begin = lines_ + 1;
    std::string_view line = next_line();
    const bool is_comment = without_blanks(line).starts_with('#');
    if (!is_comment && line.ends_with('\\')) {
      joined_.clear();
      for (; line.ends_with('\\') && !left_.empty(); line = next_line())
        joined_.append(line.substr(0, line.size() - 1)) += ' ';
      joined_ += line.ends_with('\\') ? line.substr(0, line.size() - 1) : line;
      line = joined_;
    }
    const std::string_view text = without_blanks(line);
    if (is_comment || text.empty()) continue;
    const std::string_view keyword = text.substr(0, text.find_first_of(kBlanks));
    return ObjStatement{text, keyword, without_blanks(text.substr(keyword.size())), begin};
  }
  return std::nullopt;
}

std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

std::string_view next_value(std::string_view& text) {
  const std::string_view word = next_word(text);
  const std::size_t comment = word.find('#');
  if (comment != word.npos) text = {};
  return word.substr(0, comment);
}

std::optional<float> obj_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool is_tiny = error == std::errc::result_out_of_range && word.find_first_of("eE") != word.npos &&
                       word.find('-', word.find_first_of("eE")) != word.npos;
  if (end != word.data() + word.size() || (error != std::errc() && !is_tiny)) return std::nullopt;
  if (!(std::abs(value) <= double{std::numeric_limits<float>::max()})) return std::nullopt;
  return is_tiny ? 0 : static_cast<float>(value);
}

std::vector<std::string> spellings_of(std::string_view name) {
  std::vector<std::string> spellings;
  const auto add = [&](std::string spelling) {
    if (!spelling.empty() && std::find(spellings.begin(), spellings.end(), spelling) == spellings.end())
      spellings.push_back(std::move(spelling));
  };
  add(std::string(name));
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  add(std::string(name));
  std::string slashed(name);
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  add(slashed);
  return spellings;
}

std::string without_folders(std::string_view name) {
  const std::string plain = spellings_of(name).empty() ? std::string() : spellings_of(name).back();
  return plain.substr(plain.rfind('/') + 1);  // npos + 1 is 0
}

}  // namespace dspm
