// The bytes of a state: counted, saved to memory, and loaded from it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dspm/base/system/parallel.h"
#include "dspm/base/system/state_stream.h"

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

/// Reads bytes that must outlive it.
class LoadedState : public StateStream {
 public:
  explicit LoadedState(std::string_view bytes) : left_(bytes) {}
  bool all_read() const { return left_.empty(); }

 protected:
  void bytes(void* data, std::size_t count) override {
    if (count > left_.size()) throw std::runtime_error("it ends too early");
    std::copy_n(left_.data(), count, static_cast<char*>(data));
    left_.remove_prefix(count);
  }

  std::string_view left_;
};

/// Adds what adds up, as merging a part does (see StateStream).
class AddedState final : public LoadedState {
 public:
  using LoadedState::LoadedState;
  bool merges() const override { return true; }

 protected:
  void combine(void* data, std::size_t count, std::size_t size, Combine* one) override {
    constexpr std::int64_t kGrain = 1 << 14;  // values
    if (count * size > left_.size()) throw std::runtime_error("it ends too early");
    parallel_chunks(static_cast<std::int64_t>(count), kGrain, [&](std::int64_t begin, std::int64_t end) {
      const std::size_t at = static_cast<std::size_t>(begin) * size,
                        bytes = static_cast<std::size_t>(end - begin) * size;
      const std::vector<char> aligned(left_.data() + at, left_.data() + at + bytes);  // as the bytes need not be
      for (std::size_t i = 0; i < bytes; i += size) one(static_cast<char*>(data) + at + i, aligned.data() + i);
    });
    left_.remove_prefix(count * size);
  }
};

/// Returns the bytes of anything with persist().
template <class Persistent>
std::string state_of(Persistent& object) {
  CountingStream size;
  object.persist(size);
  SavedState state;
  state.all.reserve(size.count());
  object.persist(state);
  return std::move(state.all);
}

/// Loads what state_of() returned. Throws std::runtime_error if the object cannot have that state.
template <class Persistent>
void load_state(std::string_view bytes, Persistent& object) {
  LoadedState state(bytes);
  object.persist(state);
}

}  // namespace dspm
