// A machine for waves that does everything in a random order, in a memory of its own: what depends on an order, or on what
// memory holds at first, shows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <new>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "dspm/integrators/waves/machine.h"
#include "dspm/integrators/waves/threads_machine.h"

namespace dspm::test {

/// Copies as the CPU does.
class RandomMachine : public ThreadsMachine {
 public:
  static constexpr bool kOwnMemory = true;

  /// `bytes`: the size of its memory.
  RandomMachine(std::uint64_t seed, std::size_t paths_at_once, std::size_t bytes = std::size_t{1} << 32)
      : random_(seed), paths_at_once_(paths_at_once), bytes_left_(bytes) {}

  void* allocate(std::size_t bytes) {
    if (bytes > bytes_left_) throw OutOfMachineMemory("the random machine's memory does not suffice");
    void* const memory = ::operator new(bytes, kAlignment);
    std::memset(memory, 0xa5, bytes);
    bytes_left_ -= bytes, sizes_[memory] = bytes;
    return memory;
  }
  void free(void* memory) {
    if (memory == nullptr) return;
    bytes_left_ += sizes_.extract(memory).mapped();
    ::operator delete(memory, kAlignment);
  }

  template <class Fn>
  void for_each(std::size_t count, const Fn& fn) {
    std::vector<std::size_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    std::ranges::shuffle(numbers, random_);
    for (const std::size_t i : numbers) fn(i);
  }

  void sort(std::uint64_t* keys, std::uint32_t* order, std::size_t count) {
    std::iota(order, order + count, 0u);
    std::sort(order, order + count, [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
    std::sort(keys, keys + count);
    if (std::adjacent_find(keys, keys + count) != keys + count) throw std::logic_error("two have the same order");
  }

  std::size_t paths_at_once() const { return paths_at_once_; }
  std::string name() const { return "a random machine"; }

 private:
  static constexpr std::align_val_t kAlignment{256};

  std::mt19937_64 random_;
  std::size_t paths_at_once_, bytes_left_;
  std::map<void*, std::size_t> sizes_;  // of what is allocated
};

}  // namespace dspm::test
