// The state of a computation on its way into or out of a checkpoint. A type names its members once, in one function:
// the same calls count, save and load them, and merge the states of parts that several machines have computed.
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

  /// Values without pointers. If parts are merged, the values are the same in all of them, or the last part's remain.
  template <class T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    bytes(&value, sizeof(T));
  }
  /// A fixed number of values: loading throws std::runtime_error if it finds a different number.
  template <class T>
  void value(std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    expect_number(values.size());
    bytes(values.data(), values.size() * sizeof(T));
  }
  /// Values that parts add up (+=).
  template <class T>
  void sum(T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    combine(&value, 1, sizeof(T), add<T>);
  }
  /// A fixed number of values that parts add up.
  template <class T>
  void sum(std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    expect_number(values.size());
    combine(values.data(), values.size(), sizeof(T), add<T>);
  }
  /// A value of which the largest of all parts remains.
  template <class T>
  void largest(T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    combine(&value, 1, sizeof(T), [](void* to, const void* from) {
      if (*static_cast<T*>(to) < *static_cast<const T*>(from)) *static_cast<T*>(to) = *static_cast<const T*>(from);
    });
  }
  /// Returns whether a part is loaded on top of what other parts have left here.
  virtual bool merges() const { return false; }

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
  /// A text of at most `most` bytes.
  void text(std::string& text, std::size_t most) {
    std::vector<char> bytes(text.begin(), text.end());
    list(bytes, most);
    text.assign(bytes.begin(), bytes.end());
  }

 protected:
  using Combine = void(void* to, const void* from);

  /// Counts, saves or replaces bytes.
  virtual void bytes(void* data, std::size_t count) = 0;
  /// Counts, saves or replaces `count` values of `size` bytes each; merging combines each of them with the part's.
  virtual void combine(void* data, std::size_t count, std::size_t size, Combine*) { bytes(data, count * size); }
  /// Announces that this many bytes follow: if they cannot, loading throws before it makes room for them.
  virtual void expect(std::size_t /*count*/) {}

 private:
  template <class T>
  static void add(void* to, const void* from) {
    *static_cast<T*>(to) += *static_cast<const T*>(from);
  }
  void expect_number(std::uint64_t wanted) {
    std::uint64_t count = wanted;
    bytes(&count, sizeof(count));
    if (count != wanted) throw std::runtime_error("it holds a different number of values than needed");
  }
};

}  // namespace dspm
