// The numbers in a PLY file's body: as text, or as bytes in either order.
#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "dspm/shapes/ply_header.h"

namespace dspm {

[[noreturn]] inline void fail_at_end() { throw std::runtime_error("the file ends early"); }

/// Numbers separated by white space.
class AsciiNumbers {
 public:
  explicit AsciiNumbers(std::string_view data) : at_(data.data()), end_(data.data() + data.size()) {}
  std::size_t rest() const { return static_cast<std::size_t>(end_ - at_); }

  double next(PlyType) {
    while (at_ != end_ && (*at_ == ' ' || (*at_ >= '\t' && *at_ <= '\r'))) ++at_;
    if (at_ == end_) fail_at_end();
    if (*at_ == '+') ++at_;
    double value = 0;
    const auto [stop, error] = std::from_chars(at_, end_, value);
    if (error != std::errc()) throw std::runtime_error("this is not a number");
    at_ = stop;
    return value;
  }

 private:
  const char* at_;
  const char* end_;
};

template <bool big_endian>
class BinaryNumbers {
 public:
  explicit BinaryNumbers(std::string_view data) : data_(data) {}
  std::size_t rest() const { return data_.size(); }

  double next(PlyType type) {
    switch (type) {
      case PlyType::int8: return take<std::int8_t>();
      case PlyType::uint8: return take<std::uint8_t>();
      case PlyType::int16: return take<std::int16_t>();
      case PlyType::uint16: return take<std::uint16_t>();
      case PlyType::int32: return take<std::int32_t>();
      case PlyType::uint32: return take<std::uint32_t>();
      case PlyType::float32: return double{take<float>()};
      case PlyType::float64: break;
    }
    return take<double>();
  }

 private:
  template <class T>
  T take() {
    if (data_.size() < sizeof(T)) fail_at_end();
    char bytes[sizeof(T)];
    std::memcpy(bytes, data_.data(), sizeof(T));
    data_.remove_prefix(sizeof(T));
    if constexpr (big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes, bytes + sizeof(T));
    return std::bit_cast<T>(bytes);
  }

  std::string_view data_;
};

}  // namespace dspm
