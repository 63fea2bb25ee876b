// The state of a computation on its way into or out of a checkpoint. A type names its members once, in one function:
// the same calls count, save and load them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace dspm {

class StateStream {
 public:
  virtual ~StateStream() = default;

  /// Values without pointers.
  template <class T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    bytes(&value, sizeof(T));
  }
  /// A fixed number of values: loading throws std::runtime_error if it finds a different number.
  template <class T>
  void value(std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    std::uint64_t count = values.size();
    bytes(&count, sizeof(count));
    if (count != values.size()) throw std::runtime_error("it holds a different number of values than needed");
    bytes(values.data(), values.size() * sizeof(T));
  }
  /// Any number of values up to `most`; loading makes room for them.
  template <class T>
  void list(std::vector<T>& values, std::size_t most) {
    std::uint64_t count = values.size();
    bytes(&count, sizeof(count));
    if (count > most) throw std::runtime_error("it holds more values than are possible");
    expect(static_cast<std::size_t>(count) * sizeof(T));
    values.resize(static_cast<std::size_t>(count));
    bytes(values.data(), values.size() * sizeof(T));
  }
  /// The same for a text of at most that many bytes.
  void text(std::string& text, std::size_t most) {
    std::vector<char> bytes(text.begin(), text.end());
    list(bytes, most);
    text.assign(bytes.begin(), bytes.end());
  }

 protected:
  /// Counts, saves or replaces them.
  virtual void bytes(void* data, std::size_t count) = 0;
  /// This many bytes follow: if they cannot, loading throws before it makes room for them.
  virtual void expect(std::size_t /*count*/) {}
};

}  // namespace dspm
