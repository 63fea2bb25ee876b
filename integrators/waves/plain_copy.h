// A copy of a plain value, such as a scene, for a machine: it points to copies, in that machine's memory, of all that the value
// points to.
//
// Plain structs say where their arrays are: value.each_array(fn) calls fn(pointer, count) for each pointer of `value`
// and of the structs within it, by reference, null or not. What is pointed to alone is an array of one. Elements that
// have arrays of their own have each_array, too.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <tuple>
#include <type_traits>
#include <typeindex>
#include <typeinfo>
#include <utility>
#include <vector>

namespace dspm {

/// What each_array() can be called with, and nothing comes of it.
struct IgnoreArray {
  template <class T>
  constexpr void operator()(const T*&, std::size_t) const {}
};
template <class T>
concept HasArrays = requires(T& value) {
  value.each_array(IgnoreArray());
};

/// Takes memory in few pieces, and frees it. Memory is a class with void* allocate(std::size_t bytes), aligned to
/// kAlignment, and void free(void*).
template <class Memory>
class Blocks {
 public:
  static constexpr std::size_t kAlignment = 256;

  explicit Blocks(Memory& memory) : memory_(memory) {}

  void* take(std::size_t bytes) {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    bytes = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    if (bytes > kBlock / 4) return allocate(bytes);
    if (bytes > left_) next_ = static_cast<std::byte*>(allocate(kBlock)), left_ = kBlock;
    left_ -= bytes;
    return std::exchange(next_, next_ + bytes);
  }

 private:
  struct Free {
    Memory* memory;
    void operator()(void* block) const { memory->free(block); }
  };

  void* allocate(std::size_t bytes) { return owned_.emplace_back(memory_.allocate(bytes), Free{&memory_}).get(); }

  Memory& memory_;
  std::vector<std::unique_ptr<void, Free>> owned_;
  std::byte* next_ = nullptr;
  std::size_t left_ = 0;
};

/// Memory is one for Blocks, which has void copy_in(void* to, const void* from, std::size_t bytes) as well.
template <class Plain, class Memory>
class PlainCopy {
 public:
  /// `memory` must outlive this; what is copied need not.
  PlainCopy(const Plain& plain, Memory& memory) : memory_(memory), blocks_(memory), value_(plain) {
    move_arrays(value_);
    copies_.clear();
  }
  PlainCopy(const PlainCopy&) = delete;
  PlainCopy& operator=(const PlainCopy&) = delete;

  /// The value is here, all that it points to is in that memory.
  const Plain& value() const { return value_; }

 private:
  using Key = std::tuple<const void*, std::size_t, std::type_index>;  // the address, the number of elements, their type

  /// Copies all arrays of `value`, and has it point to the copies; those of no elements become null.
  template <class T>
  void move_arrays(T& value) {
    value.each_array([this](auto& array, std::size_t count) { array = this->copy_of(array, count); });
  }

  template <class T>
  const T* copy_of(const T* array, std::size_t count) {
    if (array == nullptr || count == 0) return nullptr;
    const auto [found, is_new] = copies_.try_emplace(Key(array, count, typeid(T)));
    if (!is_new) return static_cast<const T*>(found->second);
    void* const copy = blocks_.take(count * sizeof(T));
    found->second = copy;
    copy_in(copy, array, count);
    return static_cast<const T*>(copy);
  }

  template <class T>
  void copy_in(void* to, const T* array, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= Blocks<Memory>::kAlignment);
    if constexpr (HasArrays<T>) {
      std::vector<T> elements(array, array + count);
      for (T& element : elements) move_arrays(element);
      memory_.copy_in(to, elements.data(), count * sizeof(T));
    } else {
      memory_.copy_in(to, array, count * sizeof(T));
    }
  }

  Memory& memory_;
  Blocks<Memory> blocks_;
  Plain value_;
  std::map<Key, const void*> copies_;  // lookups only, so addresses affect no result
};

}  // namespace dspm
