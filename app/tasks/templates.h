// The files of app/templates, as CMakeLists.txt puts them into the program.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace dspm {

struct Template {
  std::string_view file;  // without ".in"
  std::string_view text;  // with @words@ to be replaced
};
std::span<const Template> templates();

/// Returns the text of a file that is there.
std::string_view template_text(std::string_view file);

using TemplateWords = std::map<std::string, std::string, std::less<>>;
/// Replaces each @word@. A line that becomes empty is left out.
std::string filled(std::string_view text, const TemplateWords& words);

/// Returns the text with a backslash before each of the characters.
std::string escaped(const std::string& text, std::string_view characters);
/// Returns the word as a shell reads it: quoted if necessary.
std::string shell_word(const std::string& word);

}  // namespace dspm
