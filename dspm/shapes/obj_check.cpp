#include "dspm/shapes/obj_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace dspm {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::size_t kMostShown = 60;

/// Takes the next word from the front of the line; empty at its end.
std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

template <class Number>
bool is(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  // What is too small for a float is as good as 0.
  if (end != word.data() + word.size() || (error != std::errc() && error != std::errc::result_out_of_range))
    return false;
  if constexpr (std::is_floating_point_v<Number>) return std::isfinite(number);
  return true;
}

/// 7, 7/1, 7//3 or 7/1/3.
bool is_corner(std::string_view word) {
  for (int slot = 0; slot < 3; ++slot) {
    const std::size_t end = std::min(word.find('/'), word.size());
    const bool may_be_missing = slot == 1 && end < word.size();
    if (!(may_be_missing && end == 0) && !is<int>(word.substr(0, end))) return false;
    if (end == word.size()) return true;
    word.remove_prefix(end + 1);
  }
  return false;
}

struct Statement {
  std::string_view word;
  int least;  // words that follow it
  bool (*is_valid)(std::string_view);
  const char* what;
};
constexpr Statement kStatements[] = {{"v", 3, is<float>, "number"},
                                     {"vn", 3, is<float>, "number"},
                                     {"vt", 1, is<float>, "number"},
                                     {"f", 1, is_corner, "vertex of a face"}};

void check(std::string_view line, const Statement& statement, int number) {
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(fmt::format("line {}: {}: {}", number, line.substr(0, kMostShown), why));
  };
  std::string_view rest = line;
  next_word(rest);
  int count = 0;
  for (std::string_view word = next_word(rest); !word.empty() && word[0] != '#'; word = next_word(rest), ++count)
    if (!statement.is_valid(word)) fail(fmt::format("\"{}\" is not a {}", word.substr(0, kMostShown), statement.what));
  if (count < statement.least) fail(fmt::format("{} of {} numbers", count, statement.least));
}

}  // namespace

void check_obj_numbers(const std::string& text) {
  std::string_view rest = text;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    std::string_view words = line;
    const std::string_view first = next_word(words);
    for (const Statement& statement : kStatements)
      if (first == statement.word) check(line, statement, number);
  }
}

}  // namespace dspm
