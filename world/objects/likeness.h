// A number that equal states have in common, so that a state of ten thousand frames need not be compared with each of
// the others. Different states seldom have it in common.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "dspm/base/math/transform.h"
#include "dspm/base/params/params.h"

namespace dspm {

class Likeness {
 public:
  std::uint64_t number() const { return number_; }

  Likeness& add(std::uint64_t value) {
    // A step of SplitMix64.
    std::uint64_t z = number_ + value + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    number_ = z ^ (z >> 31);
    return *this;
  }
  Likeness& add(int value) { return add(static_cast<std::uint64_t>(value)); }
  Likeness& add(double value) { return add(std::bit_cast<std::uint64_t>(value + 0.0)); }  // -0 is the same as 0
  Likeness& add(const void* address) { return add(std::bit_cast<std::uint64_t>(address)); }
  Likeness& add(std::string_view text) { return add(static_cast<std::uint64_t>(std::hash<std::string_view>{}(text))); }
  Likeness& add(const Matrix4& matrix) {
    for (const auto& row : matrix.m)
      for (const double value : row) add(value);
    return *this;
  }
  /// Adds the parameters, in any order: see ParamList::same_values.
  Likeness& add(const ParamList& list) {
    std::uint64_t sum = 0;
    for (const Param& param : list.params) sum += Likeness().add(param).number();
    return add(sum);
  }

 private:
  Likeness& add(const Param& param) {
    add(std::string_view(param.name));
    std::visit(
        [&](const auto& values) {
          for (const auto& value : values) {
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, std::string>)
              add(std::string_view(value));
            else if constexpr (std::is_same_v<Value, float>)
              add(static_cast<double>(value));
            else
              add(static_cast<int>(value));
          }
        },
        param.values);
    return *this;
  }

  std::uint64_t number_ = 0;
};

}  // namespace dspm
