#include <algorithm>

#include "dspm/app/tasks/templates.h"

namespace dspm {

std::string_view template_text(std::string_view file) {
  const auto all = templates();
  return std::find_if(all.begin(), all.end(), [&](const Template& t) { return t.file == file; })->text;
}

std::string filled(std::string_view text, const TemplateWords& words) {
  std::string result;
  while (!text.empty()) {
    std::string line(text.substr(0, text.find('\n')));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const bool was_empty = line.empty();
    for (const auto& [word, value] : words)
      for (std::size_t at = 0; (at = line.find("@" + word + "@", at)) != line.npos; at += value.size())
        line.replace(at, word.size() + 2, value);
    if (was_empty || line.find_first_not_of(' ') != line.npos) result += line + "\n";
  }
  return result;
}

std::string escaped(const std::string& text, std::string_view characters) {
  std::string all;
  for (const char c : text) {
    if (characters.find(c) != characters.npos) all += '\\';
    all += c;
  }
  return all;
}

std::string shell_word(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace dspm
