#include "app/frame_intervals.h"

#include <algorithm>

namespace dspm {

std::vector<std::span<const Frame>> cut_into_intervals(std::span<const Frame> frames, int together) {
  const auto most = static_cast<std::size_t>(together);
  const std::size_t count = (frames.size() + most - 1) / most, length = (frames.size() + count - 1) / count;
  std::vector<std::span<const Frame>> intervals;
  for (std::size_t first = 0; first < frames.size(); first += length)
    intervals.push_back(frames.subspan(first, std::min(length, frames.size() - first)));
  return intervals;
}

}  // namespace dspm
