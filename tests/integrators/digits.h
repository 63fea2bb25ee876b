// Numbers as text that tells them apart bit by bit.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>

namespace dspm::test {

inline std::string digits(float x) { return fmt::format("{:08x}", std::bit_cast<std::uint32_t>(x)); }

/// The same of vectors and colours.
template <class Three>
std::string digits(const Three& v) {
  return digits(v[0]) + digits(v[1]) + digits(v[2]);
}

}  // namespace dspm::test
