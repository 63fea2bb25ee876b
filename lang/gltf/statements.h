// Statements of the scene language as text: a directive with its parameters, which may differ from frame to frame.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

namespace dspm::gltf {

std::string in_quotes(const std::string& text);

template <class Numbers>
std::string listed(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers) text += fmt::format("{}{}", text.empty() ? "" : " ", static_cast<float>(number));
  return text;
}

struct Parameter {
  std::string type, name, value;
  bool is_usual = false;  // what is not said has this value; needed if other frames have another

  friend bool operator==(const Parameter&, const Parameter&) = default;
};

struct Statement {
  std::string head;  // `Material "principled"`
  std::vector<Parameter> parameters = {};

  void set(std::string type, std::string name, std::string value) {
    parameters.push_back({std::move(type), std::move(name), std::move(value)});
  }
  void number(const char* name, double value, double usual) {
    set("float", name, fmt::format("{}", static_cast<float>(value)));
    parameters.back().is_usual = value == usual;
  }
  template <class Colour>
  void rgb(const char* name, const Colour& value) {
    set("rgb", name, fmt::format("[{}]", listed(value)));
  }
  void flag(const char* name, bool value) { set("bool", name, value ? "true" : "false"); }
  void string(const char* name, const std::string& value) { set("string", name, in_quotes(value)); }
  void texture(const char* name, const std::string& value) { set("texture", name, in_quotes(value)); }

  friend bool operator==(const Statement&, const Statement&) = default;
};

/// Returns the statement on one line.
std::string text_of(const Statement& statement);

/// Returns one statement for all frames, in which what differs between them is keyed. The head is that of the first. A
/// parameter that is not in all frames, or changes its type, keeps what the first frame has.
Statement keyed(std::span<const Statement> frames);

}  // namespace dspm::gltf
