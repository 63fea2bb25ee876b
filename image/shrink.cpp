#include "dspm/image/shrink.h"

#include <algorithm>
#include <cstdint>

namespace dspm {

namespace {

struct Share {
  int from;
  float weight;
};

/// Returns, for each of `to` cells, the cells out of `from` that it covers and their shares, which add up to 1.
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

using Shares = std::vector<std::vector<Share>>;

/// Shrinks the values of an image's pixels, row by row.
template <class T>
std::vector<T> shrunk(const std::vector<T>& values, int width, const Shares& columns, const Shares& rows) {
  const std::size_t from = static_cast<std::size_t>(width), to = columns.size(), height = values.size() / from;
  std::vector<T> narrow(to * height, T(0)), result(to * rows.size(), T(0));
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < to; ++x)
      for (const Share& share : columns[x])
        narrow[y * to + x] += values[y * from + static_cast<std::size_t>(share.from)] * share.weight;
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (const Share& share : rows[y])
      for (std::size_t x = 0; x < to; ++x)
        result[y * to + x] += narrow[static_cast<std::size_t>(share.from) * to + x] * share.weight;
  return result;
}

}  // namespace

Image shrunk(const Image& image, int width, int height) {
  const Shares columns = shares(image.width, width), rows = shares(image.height, height);
  Image result;
  result.width = width, result.height = height;
  result.pixels = shrunk(image.pixels, image.width, columns, rows);
  if (!image.alpha.empty()) result.alpha = shrunk(image.alpha, image.width, columns, rows);
  return result;
}

}  // namespace dspm
