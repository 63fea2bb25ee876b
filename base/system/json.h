// Writes JSON, one value after the other.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace dspm {

/// Keys come before values within objects; every begin has its end. Numbers that JSON lacks become null.
class JsonWriter {
 public:
  JsonWriter& key(std::string_view name);
  void begin_object() { open('{'); }
  void end_object() { close('}'); }
  void begin_array() { open('['); }
  void end_array() { close(']'); }

  void value(std::string_view text);
  void value(const char* text) { value(std::string_view(text)); }
  void value(double number);
  void value(std::integral auto number) { raw(std::to_string(number)); }

  template <class T>
  void member(std::string_view name, const T& content) {
    key(name).value(content);
  }

  const std::string& text() const { return text_; }

 private:
  void open(char bracket);
  void close(char bracket);
  void raw(std::string_view text);
  void separate();  // comma, line break and indentation, as needed

  std::string text_;
  int depth_ = 0;
  bool after_key_ = false, first_ = true;
};

}  // namespace dspm
