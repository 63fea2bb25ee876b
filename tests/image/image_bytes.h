// Files written byte by byte, and what reading them must say.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>

#include "dspm/image/decoders.h"

namespace dspm::test {

inline std::string bytes(std::initializer_list<int> values) {
  std::string result;
  for (const int value : values) result.push_back(static_cast<char>(value));
  return result;
}

/// Returns the number in the four bytes from there, the most significant one first.
inline std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return number;
}

inline const ColorEncoding kLinear{ColorEncoding::Kind::linear, 1};

/// "" if the file is read.
inline std::string message_for(const std::string& file) {
  try {
    decode_image(file, {});
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

/// Each file that ends too early is an error.
inline void expect_errors_when_truncated(const std::string& file) {
  ASSERT_EQ(message_for(file), "");
  for (std::size_t length = 0; length < file.size(); ++length)
    EXPECT_NE(message_for(file.substr(0, length)), "") << length << " of " << file.size() << " bytes";
}

}  // namespace dspm::test
