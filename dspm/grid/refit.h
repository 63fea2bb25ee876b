// Buffers that are refilled in every iteration, each time with about as much.
#pragma once

#include <cstddef>
#include <vector>

namespace dspm {

/// Makes room for `count` elements and discards the contents. A growing buffer releases its old memory first and
/// allocates slightly more than needed: std::vector would hold both for a while, and then twice as much permanently.
template <class T>
void refit(std::vector<T>& buffer, std::size_t count) {
  if (count > buffer.capacity()) {
    buffer = {};
    buffer.reserve(count + count / 16);
  }
  buffer.resize(count);
}

}  // namespace dspm
