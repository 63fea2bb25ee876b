// What every fuzz target is: one function that takes any bytes. It may refuse them, but must neither crash nor read
// beyond what it has, nor take long; what it throws on purpose it catches itself. libFuzzer calls it with inputs that
// it makes up (./dev fuzz), replay.cpp with those of tests/fuzz/corpus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace dspm::fuzz {

inline std::string_view text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// For what must hold whatever the input is; libFuzzer keeps inputs that throw.
inline void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace dspm::fuzz
