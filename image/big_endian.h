// Numbers as files for all kinds of machines hold them.
#pragma once

#include <cstdint>
#include <string>

namespace dspm {

/// Returns the number's lowest bytes, the most significant one first.
inline std::string big_endian(std::uint32_t value, int bytes = 4) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text.push_back(static_cast<char>(value >> (8 * i) & 0xff));
  return text;
}

}  // namespace dspm
