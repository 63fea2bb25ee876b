// Buffers that are filled anew in every iteration, each time by about as much.
#pragma once

#include <cstddef>
#include <vector>

namespace dspm {

/// Makes room for `count` elements, whatever they were. What grows lets go of its old memory first and takes a little
/// more than it needs: std::vector would hold both for a while, and then twice as much for good.
template <class T>
void refit(std::vector<T>& buffer, std::size_t count) {
  if (count > buffer.capacity()) {
    buffer = {};
    buffer.reserve(count + count / 16);
  }
  buffer.resize(count);
}

}  // namespace dspm
