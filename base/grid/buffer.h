// An array that is refilled in every iteration, each time with about as much.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace dspm {

namespace detail {
/// Returns memory aligned to cache lines; large arrays lie in huge pages, if the kernel has some.
void* new_array(std::size_t bytes);
void delete_array(void* memory, std::size_t bytes);
}  // namespace detail

/// Elements are not initialised: one thread would do that, and on machines with several memories (NUMA) all pages would
/// lie in the memory of that thread. Instead, the threads that fill the array touch its pages first.
template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  /// Makes room for `count` elements and discards the contents. A growing buffer releases its old memory first and
  /// allocates slightly more than needed: std::vector would hold both for a while, and then twice as much permanently.
  void refit(std::size_t count) {
    if (count > bytes() / sizeof(T)) {
      memory_ = {}, size_ = 0;
      const std::size_t room = count + count / 16;
      memory_ = Memory(static_cast<T*>(detail::new_array(room * sizeof(T))), Free{room * sizeof(T)});
    }
    size_ = count;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t bytes() const { return memory_ ? memory_.get_deleter().bytes : 0; }
  T* data() { return memory_.get(); }
  const T* data() const { return memory_.get(); }
  T* begin() { return data(); }
  const T* begin() const { return data(); }
  T* end() { return data() + size_; }
  const T* end() const { return data() + size_; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  T& back() { return data()[size_ - 1]; }

 private:
  struct Free {
    std::size_t bytes = 0;
    void operator()(T* memory) const { detail::delete_array(memory, bytes); }
  };
  using Memory = std::unique_ptr<T, Free>;
  Memory memory_;
  std::size_t size_ = 0;
};

}  // namespace dspm
