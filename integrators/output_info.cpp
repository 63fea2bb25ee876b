#include "dspm/integrators/output_info.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace dspm {

std::uint32_t name_hash(const std::string& text) {
  constexpr std::uint32_t kC1 = 0xcc9e2d51, kC2 = 0x1b873593;
  std::uint32_t hash = 0;
  std::size_t at = 0;
  for (; at + 4 <= text.size(); at += 4) {
    std::uint32_t block;
    std::memcpy(&block, text.data() + at, sizeof block);
    hash ^= std::rotl(block * kC1, 15) * kC2;
    hash = std::rotl(hash, 13) * 5 + 0xe6546b64;
  }
  std::uint32_t rest = 0;
  for (std::size_t i = text.size(); i-- > at;) rest = rest << 8 | static_cast<std::uint8_t>(text[i]);
  hash ^= std::rotl(rest * kC1, 15) * kC2;
  hash ^= static_cast<std::uint32_t>(text.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6b;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35;
  return hash ^ hash >> 16;
}

float id_of(const std::string& name) {
  std::uint32_t bits = name_hash(name);
  const std::uint32_t exponent = bits >> 23 & 255;
  if (exponent == 0 || exponent == 255) bits ^= 1U << 23;  // neither denormal nor infinite nor NaN
  return std::bit_cast<float>(bits);
}

}  // namespace dspm
