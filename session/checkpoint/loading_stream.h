// A state on its way out of a file, and on its way to that of other parts, to which it is added.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <stdexcept>
#include <vector>

#include "dspm/base/system/state_stream.h"

namespace dspm {

class LoadingStream : public StateStream {
 public:
  static constexpr std::size_t kBlock = 1 << 20;

  /// Reads at most `left` bytes, from the file's current position.
  LoadingStream(std::istream& file, std::uint64_t left) : file_(file), left_(left) {}
  std::uint64_t left() const { return left_; }

 protected:
  void bytes(void* data, std::size_t count) override {
    expect(count);
    if (!file_.read(static_cast<char*>(data), static_cast<std::streamsize>(count)))
      throw std::runtime_error("it cannot be read");
    left_ -= count;
  }
  void expect(std::size_t count) override {
    if (count > left_) throw std::runtime_error("it ends too early");
  }

 private:
  std::istream& file_;
  std::uint64_t left_;
};

/// Adds what parts add up.
class AddingStream final : public LoadingStream {
 public:
  using LoadingStream::LoadingStream;
  bool merges() const override { return true; }

 protected:
  void combine(void* data, std::size_t count, std::size_t size, Combine* one) override {
    expect(count * size);
    std::vector<std::byte> block(std::min(count, std::max<std::size_t>(kBlock / size, 1)) * size);
    for (auto to = static_cast<std::byte*>(data), end = to + count * size; to < end;) {
      const std::size_t now = std::min(block.size(), static_cast<std::size_t>(end - to));
      bytes(block.data(), now);
      for (const std::byte* from = block.data(); from < block.data() + now; from += size, to += size) one(to, from);
    }
  }
};

}  // namespace dspm
