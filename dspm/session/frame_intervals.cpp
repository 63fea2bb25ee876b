#include "dspm/session/frame_intervals.h"

#include <algorithm>
#include <set>
#include <utility>

namespace dspm {
namespace {

using Parts = std::span<const std::span<const FileFrame>>;

std::size_t frames_in(Parts parts) {
  std::size_t sum = 0;
  for (const std::span<const FileFrame> part : parts) sum += part.size();
  return sum;
}

/// Packs of consecutive parts, each of as many as fit.
std::vector<Parts> packed(Parts parts, std::size_t together) {
  std::vector<Parts> packs;
  for (std::size_t first = 0; first < parts.size();) {
    std::size_t count = 1;
    while (first + count < parts.size() && frames_in(parts.subspan(first, count + 1)) <= together) ++count;
    packs.push_back(parts.subspan(first, count));
    first += count;
  }
  return packs;
}

/// The same number of packs, of nearly equal numbers of parts.
std::vector<Parts> evened(Parts parts, std::size_t packs) {
  std::vector<Parts> even;
  for (std::size_t i = 0; i < packs; ++i) {
    const std::size_t begin = i * parts.size() / packs, end = (i + 1) * parts.size() / packs;
    even.push_back(parts.subspan(begin, end - begin));
  }
  return even;
}

FrameList ascending(Parts parts) {
  FrameList frames;
  for (const std::span<const FileFrame> part : parts) frames.insert(frames.end(), part.begin(), part.end());
  std::sort(frames.begin(), frames.end());
  return frames;
}

}  // namespace

FrameIntervals::FrameIntervals(const SceneDescription& scene, const FrameList& frames)
    : file_(scene.frames), sorted_(frames) {
  std::vector<std::pair<Factor, std::size_t>> factors;  // with the number of places that occur
  for (const Factor& factor : factors_of(scene)) {
    std::set<int> places;
    for (const FileFrame frame : frames) places.insert(place_along(factor, file_, frame));
    factors.emplace_back(factor, places.size());
  }
  std::stable_sort(factors.begin(), factors.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.moves_paths, a.second) > std::pair(b.first.moves_paths, b.second);
  });
  for (const auto& [factor, places] : factors) factors_.push_back(factor);
  std::stable_sort(sorted_.begin(), sorted_.end(), [&](FileFrame a, FileFrame b) {
    for (const Factor& factor : factors_)
      if (const int x = place_along(factor, file_, a), y = place_along(factor, file_, b); x != y) return x < y;
    return false;
  });
}

std::vector<FrameIntervals::Part> FrameIntervals::blocks(Part part, std::size_t factor) const {
  std::vector<Part> result;
  const auto place = [&](std::size_t i) { return place_along(factors_[factor], file_, part[i]); };
  for (std::size_t first = 0, end = 0; first < part.size(); first = end) {
    while (end < part.size() && place(end) == place(first)) ++end;
    result.push_back(part.subspan(first, end - first));
  }
  return result;
}

void FrameIntervals::cut(Part part, std::size_t factor, std::size_t together, std::vector<FrameList>& intervals) const {
  const std::vector<Part> parts = blocks(part, factor);
  if (std::any_of(parts.begin(), parts.end(), [&](const Part& each) { return each.size() > together; })) {
    for (const Part& each : parts) cut(each, factor + 1, together, intervals);
    return;
  }
  std::vector<Parts> packs = packed(parts, together);
  const std::vector<Parts> even = evened(parts, packs.size());
  if (std::all_of(even.begin(), even.end(), [&](Parts each) { return frames_in(each) <= together; })) packs = even;
  for (const Parts& pack : packs) intervals.push_back(ascending(pack));
}

std::vector<FrameList> FrameIntervals::cut(int together) const {
  std::vector<FrameList> intervals;
  cut(sorted_, 0, static_cast<std::size_t>(together), intervals);
  std::sort(intervals.begin(), intervals.end());
  return intervals;
}

}  // namespace dspm
