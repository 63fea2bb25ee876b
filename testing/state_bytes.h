// The state of an integrator as bytes in memory.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/state_stream.h"

namespace dspm::test {

class SavedState final : public StateStream {
 public:
  std::string all;

 protected:
  void bytes(void* data, std::size_t count) override { all.append(static_cast<const char*>(data), count); }
};

class LoadedState final : public StateStream {
 public:
  explicit LoadedState(std::string bytes) : left_(std::move(bytes)) {}
  bool all_read() const { return left_.empty(); }

 protected:
  void bytes(void* data, std::size_t count) override {
    if (count > left_.size()) throw std::runtime_error("there are not as many bytes");
    std::copy_n(left_.data(), count, static_cast<char*>(data));
    left_.erase(0, count);
  }

 private:
  std::string left_;
};

/// Of anything with persist().
template <class Persistent>
std::string state_of(Persistent& object) {
  SavedState state;
  object.persist(state);
  return state.all;
}

}  // namespace dspm::test
