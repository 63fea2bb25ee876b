// The state of a computation on its way into a checkpoint or out of it. A type names its parts once, in one function:
// the same calls count, save and load them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace dspm {

class StateStream {
 public:
  virtual ~StateStream() = default;

  /// Values without pointers.
  template <class T>
  void part(T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    bytes(&value, sizeof(T));
  }
  /// As many as there are: loading throws std::runtime_error where it finds another number.
  template <class T>
  void part(std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    std::uint64_t count = values.size();
    bytes(&count, sizeof(count));
    if (count != values.size()) throw std::runtime_error("it holds another number of values than are needed");
    bytes(values.data(), values.size() * sizeof(T));
  }
  /// Any number up to `most`; loading makes room for them.
  template <class T>
  void list(std::vector<T>& values, std::size_t most) {
    std::uint64_t count = values.size();
    bytes(&count, sizeof(count));
    if (count > most) throw std::runtime_error("it holds more values than there can be");
    expect(static_cast<std::size_t>(count) * sizeof(T));
    values.resize(static_cast<std::size_t>(count));
    bytes(values.data(), values.size() * sizeof(T));
  }

 protected:
  /// Counts, saves or replaces them.
  virtual void bytes(void* data, std::size_t count) = 0;
  /// As many will follow: where they cannot, loading throws before room is made for them.
  virtual void expect(std::size_t /*count*/) {}
};

}  // namespace dspm
