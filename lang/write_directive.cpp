#include "dspm/lang/write_directive.h"

#include <fmt/format.h>

#include <variant>

namespace dspm {
namespace {

std::string quoted(const std::string& text) {
  constexpr std::string_view kLetters = "bfnrt\\\"", kMeanings = "\b\f\n\r\t\\\"";
  std::string result = "\"";
  for (const char c : text) {
    const std::size_t which = kMeanings.find(c);
    if (which != kMeanings.npos)
      result.append({'\\', kLetters[which]});
    else
      result.push_back(c);
  }
  return result + "\"";
}

std::string word_of_value(const std::string& value) { return quoted(value); }
std::string word_of_value(bool value) { return value ? "true" : "false"; }
std::string word_of_value(int value) { return fmt::format("{}", value); }
std::string word_of_value(float value) { return fmt::format("{}", value); }
std::string word_of_value(double value) { return fmt::format("{}", value); }

template <class Value>
std::string list_of(const std::vector<Value>& values) {
  std::string text;
  for (auto&& value : values) (text += text.empty() ? "" : " ") += word_of_value(value);
  return text;
}

std::string text_of(const Param& param) {
  const std::string key = param.key ? fmt::format("@{}", number_of(*param.key)) : "";
  const std::string values = std::visit([](const auto& list) { return list_of(list); }, param.values);
  const std::size_t count = std::visit([](const auto& list) { return list.size(); }, param.values);
  return fmt::format("\"{} {}{}\" {}{}{}", word_of(param.type), param.name, key, count == 1 ? "" : "[", values,
                     count == 1 ? "" : "]");
}

/// Of a LookAt: its eye and target may be names.
std::string text_of_view(const Directive& directive) {
  std::string text(directive.info->name);
  for (std::size_t i = 0; i < directive.numbers.size(); i += 3) {
    const bool is_named = i / 3 < directive.words.size() && !directive.words[i / 3].text.empty();
    if (is_named)
      text += ' ' + quoted(directive.words[i / 3].text);
    else
      for (std::size_t k = i; k < i + 3; ++k) text += ' ' + word_of_value(directive.numbers[k]);
  }
  return text;
}

}  // namespace

std::string text_of(const Directive& directive) {
  if (directive.info->kind == DirectiveKind::look_at) return text_of_view(directive);
  std::string text(directive.info->name);
  auto word = directive.words.begin();
  for (const char argument : directive.info->arguments)
    if (std::string_view("sSwv").find(argument) != std::string_view::npos && word != directive.words.end()) {
      const bool is_bare = argument == 'w' || argument == 'v';
      text += ' ' + (is_bare ? word->text : quoted(word->text));
      ++word;
    }
  const std::string numbers = list_of(directive.numbers);
  if (!numbers.empty()) text += ' ' + (directive.info->arguments == "m" ? '[' + numbers + ']' : numbers);
  for (const Param& param : directive.params.params) text += ' ' + text_of(param);
  return text;
}

}  // namespace dspm
