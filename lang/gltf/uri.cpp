#include "dspm/lang/gltf/uri.h"

#include <cctype>
#include <cstdint>
#include <stdexcept>

namespace dspm::gltf {
namespace {

constexpr std::string_view kData = "data:";

int value_of_base64(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

std::string bytes_of_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int value = value_of_base64(c);
    if (value < 0) throw std::runtime_error("its base64 data is damaged");
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> count & 255));
  }
  return bytes;
}

int hexadecimal(char c) {
  return c >= '0' && c <= '9'   ? c - '0'
         : c >= 'a' && c <= 'f' ? c - 'a' + 10
         : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                : -1;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::optional<std::string> data_of_uri(std::string_view uri) {
  if (lower_case(uri.substr(0, kData.size())) != kData) return std::nullopt;
  const std::size_t comma = uri.find(',');
  if (comma == uri.npos) throw std::runtime_error("its data URI has no data");
  const std::string_view data = uri.substr(comma + 1);
  return lower_case(uri.substr(0, comma)).ends_with(";base64") ? bytes_of_base64(data) : unescaped(data);
}

std::optional<std::string> type_of_data_uri(std::string_view uri) {
  if (lower_case(uri.substr(0, kData.size())) != kData) return std::nullopt;
  const std::string_view rest = uri.substr(kData.size());
  return lower_case(rest.substr(0, rest.find_first_of(";,")));
}

std::string unescaped(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hexadecimal(uri[i + 1]) : -1;
    const int low = high >= 0 ? hexadecimal(uri[i + 2]) : -1;
    if (low >= 0)
      text.push_back(static_cast<char>(high * 16 + low)), i += 2;
    else
      text.push_back(uri[i]);
  }
  return text;
}

}  // namespace dspm::gltf
