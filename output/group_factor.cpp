#include "dspm/output/group_factor.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>
#include <vector>

#include "dspm/base/params/errors.h"

namespace dspm {
namespace {

/// Splits the text into words and brackets.
std::vector<std::string> tokens_of(const std::string& text) {
  std::string spaced;
  for (const char c : text) spaced += c == '[' || c == ']' ? fmt::format(" {} ", c) : std::string(1, c);
  std::istringstream words(spaced);
  return {std::istream_iterator<std::string>(words), {}};
}

/// Returns a number that is finite and not negative; nullopt for other words.
std::optional<float> number(const std::string& word) {
  float value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool good = error == std::errc{} && end == word.data() + word.size() && std::isfinite(value) && value >= 0;
  return good ? std::optional(value) : std::nullopt;
}

}  // namespace

GroupFactor parse_group_factor(const std::string& text) {
  const auto wrong = [&] {
    return UsageError(
        fmt::format("--relight \"{}\": expected a group, a factor and perhaps a colour: \"key 0.5 [1 .8 .6]\"", text));
  };
  std::vector<std::string> tokens = tokens_of(text);
  if (tokens.size() < 2) throw wrong();
  GroupFactor result{tokens[0], Rgb(1)};
  auto token = tokens.begin() + 1;
  if (*token != "[") {
    const auto factor = number(*token++);
    if (!factor) throw wrong();
    result.factor = Rgb(*factor);
  }
  if (token == tokens.end()) return result;
  if (tokens.end() - token != 5 || *token != "[" || tokens.back() != "]") throw wrong();
  for (int c = 0; c < 3; ++c) {
    const auto component = number(*++token);
    if (!component) throw wrong();
    result.factor[c] *= *component;
  }
  return result;
}

}  // namespace dspm
