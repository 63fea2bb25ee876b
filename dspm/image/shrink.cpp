#include "dspm/image/shrink.h"

#include <algorithm>
#include <cstdint>

namespace dspm {

namespace {

struct Share {
  int from;
  float weight;
};

/// For each of `to` cells, the cells out of `from` that it covers and their shares, which add up to 1.
std::vector<std::vector<Share>> shares(int from, int to) {
  std::vector<std::vector<Share>> result(static_cast<std::size_t>(to));
  // In units of 1 / (from to): old cells are `to` long, new ones `from`; integers make the shares exact.
  for (std::int64_t i = 0; i < to; ++i) {
    const std::int64_t begin = i * from, end = begin + from;
    for (std::int64_t old = begin / to; old * to < end; ++old) {
      const std::int64_t covered = std::min(end, (old + 1) * to) - std::max(begin, old * to);
      result[static_cast<std::size_t>(i)].push_back(
          {static_cast<int>(old), static_cast<float>(covered) / static_cast<float>(from)});
    }
  }
  return result;
}

}  // namespace

Image shrunk(const Image& image, int width, int height) {
  const auto columns = shares(image.width, width), rows = shares(image.height, height);
  Image narrow(width, image.height);
  for (int y = 0; y < narrow.height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const Share& share : columns[static_cast<std::size_t>(x)]) {
        narrow.at(x, y) += image.at(share.from, y) * share.weight;
      }
    }
  }
  Image result(width, height);
  for (int y = 0; y < height; ++y) {
    for (const Share& share : rows[static_cast<std::size_t>(y)]) {
      for (int x = 0; x < width; ++x) result.at(x, y) += narrow.at(x, share.from) * share.weight;
    }
  }
  return result;
}

}  // namespace dspm
