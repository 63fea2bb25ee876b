#include "dspm/base/system/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dspm {
namespace {

/// Returns the UTF-8 character that the text begins with; empty if that is malformed. [RFC 3629, section 4]
std::string_view first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned head = byte(0);
  if (head < 0x80) return text.substr(0, 1);
  const std::size_t length = head < 0xC2 ? 0 : head < 0xE0 ? 2 : head < 0xF0 ? 3 : head < 0xF5 ? 4 : 0;
  // The second byte rules out overlong forms, surrogates, and code points beyond U+10FFFF.
  const unsigned low = head == 0xE0 ? 0xA0 : head == 0xF0 ? 0x90 : 0x80;
  const unsigned high = head == 0xED ? 0x9F : head == 0xF4 ? 0x8F : 0xBF;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) < (i == 1 ? low : 0x80) || byte(i) > (i == 1 ? high : 0xBF)) return {};
  return text.substr(0, length);
}

/// File names may be any bytes; those that are not UTF-8 become U+FFFD.
std::string quoted(std::string_view text) {
  std::string result = "\"";
  while (!text.empty()) {
    const std::string_view character = first_character(text);
    const char c = text.front();
    if (character.empty()) {
      result += "\\ufffd";
    } else if (static_cast<unsigned char>(c) < ' ') {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += character;
    }
    text.remove_prefix(std::max<std::size_t>(character.size(), 1));
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
