#include "dspm/lang/gltf/statements.h"

#include <algorithm>

namespace dspm::gltf {

std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result.push_back('\\');
    result.push_back(static_cast<unsigned char>(c) < ' ' ? ' ' : c == '$' ? '_' : c);  // $name would be replaced
  }
  return result + "\"";
}

std::string text_of(const Statement& statement) {
  std::string text = statement.head;
  for (const Parameter& p : statement.parameters)
    if (!p.is_usual) text += fmt::format(" \"{} {}\" {}", p.type, p.name, p.value);
  return text;
}

Statement keyed(std::span<const Statement> frames) {
  Statement result{frames.front().head};
  for (const Parameter& first : frames.front().parameters) {
    std::vector<const Parameter*> of_frames;
    for (const Statement& frame : frames) {
      const auto found = std::find_if(frame.parameters.begin(), frame.parameters.end(),
                                      [&](const Parameter& p) { return p.name == first.name && p.type == first.type; });
      of_frames.push_back(found == frame.parameters.end() ? &first : &*found);
    }
    const auto differs = [&](std::size_t a, std::size_t b) { return of_frames[a]->value != of_frames[b]->value; };
    bool rests = true;
    for (std::size_t i = 1; i < of_frames.size(); ++i) rests = rests && !differs(0, i);
    if (rests) {
      result.parameters.push_back(first);
      continue;
    }
    for (std::size_t i = 0; i < of_frames.size(); ++i) {
      const bool needed = i == 0 || i + 1 == of_frames.size() || differs(i, i - 1) || differs(i, i + 1);
      if (needed) result.set(first.type, fmt::format("{}@{}", first.name, i + 1), of_frames[i]->value);
    }
  }
  return result;
}

}  // namespace dspm::gltf
