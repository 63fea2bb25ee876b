// Places in memory that the steps of a wave add to while others do.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

namespace dspm {

/// Adds to what any other may add to, and returns what it was.
constexpr std::uint32_t add_among_all(std::uint32_t& sum, std::uint32_t value) {
  if (std::is_constant_evaluated()) return std::exchange(sum, sum + value);
#if defined(__CUDA_ARCH__) && !defined(__clang__)
  return atomicAdd(&sum, value);
#else
  return __atomic_fetch_add(&sum, value, __ATOMIC_RELAXED);
#endif
}

/// Adds to what only those add to that share it (kSharers).
constexpr void add_among_sharers(std::int64_t& sum, std::int64_t value) {
#if defined(__CUDA_ARCH__) && !defined(__clang__)
  atomicAdd(reinterpret_cast<unsigned long long*>(&sum), static_cast<unsigned long long>(value));
#else
#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
  if (!std::is_constant_evaluated()) {
    __atomic_fetch_add(&sum, value, __ATOMIC_RELAXED);
    return;
  }
#endif
  sum += value;
#endif
}

/// A list to which all steps of a wave append, in no order.
template <class T>
struct WaveList {
  T* items = nullptr;
  std::uint32_t* size = nullptr;  // above `room`: what came then is lost, and the wave is to be done again
  std::uint32_t room = 0;

  constexpr void append(const T& item) const {
    const std::uint32_t place = add_among_all(*size, 1);
    if (place < room) items[place] = item;
  }
};

}  // namespace dspm
