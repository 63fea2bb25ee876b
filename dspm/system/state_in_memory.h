// The bytes of a state: counted, saved to memory, and loaded from it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "dspm/system/state_stream.h"

namespace dspm {

class CountingStream final : public StateStream {
 public:
  std::uint64_t count() const { return count_; }

 protected:
  void bytes(void*, std::size_t count) override { count_ += count; }

 private:
  std::uint64_t count_ = 0;
};

class SavedState final : public StateStream {
 public:
  std::string all;

 protected:
  void bytes(void* data, std::size_t count) override { all.append(static_cast<const char*>(data), count); }
};

/// Reads bytes that outlive it.
class LoadedState final : public StateStream {
 public:
  explicit LoadedState(std::string_view bytes) : left_(bytes) {}
  bool all_read() const { return left_.empty(); }

 protected:
  void bytes(void* data, std::size_t count) override {
    if (count > left_.size()) throw std::runtime_error("it ends too early");
    std::copy_n(left_.data(), count, static_cast<char*>(data));
    left_.remove_prefix(count);
  }

 private:
  std::string_view left_;
};

/// The bytes of anything with persist().
template <class Persistent>
std::string state_of(Persistent& object) {
  CountingStream size;
  object.persist(size);
  SavedState state;
  state.all.reserve(size.count());
  object.persist(state);
  return std::move(state.all);
}

}  // namespace dspm
