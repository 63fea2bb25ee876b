// The CPU's threads as a machine for waves, see machine.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "dspm/base/system/parallel.h"
#include "dspm/base/system/parallel_sort.h"
#include "dspm/integrators/waves/machine.h"

namespace dspm {

class ThreadsMachine {
 public:
  static constexpr bool kOwnMemory = false;

  void* allocate(std::size_t bytes) { return ::operator new(bytes, kAlignment); }
  void free(void* memory) { ::operator delete(memory, kAlignment); }
  void copy_in(void* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
  void copy_out(void* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
  void copy(void* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
  void clear(void* to, std::size_t bytes) { std::memset(to, 0, bytes); }

  template <class Fn>
  void for_each(std::size_t count, const Fn& fn) {
    parallel_for(static_cast<std::int64_t>(count), kSharers, [&](std::int64_t i) { fn(static_cast<std::size_t>(i)); });
  }

  void sort(std::uint64_t* keys, std::uint32_t* order, std::size_t count) {
    UntouchedVector<Numbered> numbered(count);
    for_each(count, [&](std::size_t i) { numbered[i] = {keys[i], static_cast<std::uint32_t>(i)}; });
    parallel_sort(numbered);
    for_each(count, [&](std::size_t i) { keys[i] = numbered[i].key, order[i] = numbered[i].number; });
  }

  /// Few enough for caches.
  std::size_t paths_at_once() const { return static_cast<std::size_t>(thread_count()) * 8192; }
  std::string name() const { return "the CPU"; }

 private:
  static constexpr std::align_val_t kAlignment{256};

  struct Numbered {
    std::uint64_t key;
    std::uint32_t number;
    friend bool operator<(const Numbered& a, const Numbered& b) { return a.key < b.key; }
  };
};

}  // namespace dspm
