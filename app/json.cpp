#include "app/json.h"

#include <fmt/format.h>

#include <cmath>

namespace dspm {
namespace {

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < ' ') {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

}  // namespace

JsonWriter& JsonWriter::key(std::string_view name) {
  raw(quoted(name));
  text_ += ": ";
  after_key_ = true;
  return *this;
}

void JsonWriter::value(std::string_view text) { raw(quoted(text)); }

void JsonWriter::value(double number) { raw(std::isfinite(number) ? fmt::format("{}", number) : "null"); }

void JsonWriter::open(char bracket) {
  raw(std::string_view(&bracket, 1));
  ++depth_;
  first_ = true;
}

void JsonWriter::close(char bracket) {
  --depth_;
  if (!first_) text_ += fmt::format("\n{:{}}", "", 2 * depth_);
  text_ += bracket;
  first_ = false;
}

void JsonWriter::raw(std::string_view text) {
  separate();
  text_ += text;
}

void JsonWriter::separate() {
  if (!after_key_ && depth_ > 0) text_ += fmt::format("{}\n{:{}}", first_ ? "" : ",", "", 2 * depth_);
  after_key_ = false;
  first_ = false;
}

}  // namespace dspm
