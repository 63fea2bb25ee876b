// Iterations that are done at once: one step of a session.
#pragma once

#include <algorithm>

namespace dspm {

struct Block {
  int begin = 0, end = 0;  // iterations

  /// Returns the block that begins at an iteration. It ends at the next multiple of `size`, but not beyond `all` unless
  /// it begins there.
  static Block from(int begin, int all, int size) {
    const int end = (begin / size + 1) * size;
    return {begin, begin < all ? std::min(end, all) : end};
  }
};

}  // namespace dspm
