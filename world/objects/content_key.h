// A key of what an object is made of, in 128 bits: equal contents have equal keys; different contents almost certainly
// do not.
#pragma once

#include <compare>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "dspm/base/math/rng.h"

namespace dspm {

class ContentKey {
 public:
  ContentKey() = default;
  explicit ContentKey(std::string_view text) { add(text); }

  void add(std::string_view bytes) {
    add(std::uint64_t{bytes.size()});
    for (; bytes.size() >= 8; bytes.remove_prefix(8)) add(word(bytes.substr(0, 8)));
    if (!bytes.empty()) add(word(bytes));
  }
  void add(std::uint64_t value) {
    a_ = mix_bits(a_ ^ value) + kStep;
    b_ = mix_bits(b_ + kStep * (value + 1));
  }
  /// Adds the object's own bytes.
  template <class T>
  void add_bytes_of(const T& object) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(std::string_view(reinterpret_cast<const char*>(&object), sizeof object));
  }
  friend auto operator<=>(const ContentKey&, const ContentKey&) = default;

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;
  static std::uint64_t word(std::string_view bytes) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes.data(), bytes.size());
    return bits;
  }

  std::uint64_t a_ = 1, b_ = 2;
};

}  // namespace dspm
