#include "dspm/session/frame_intervals.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace dspm {
namespace {

using FrameSpans = std::span<const FrameSpan>;

std::size_t frames_in(FrameSpans spans) {
  std::size_t sum = 0;
  for (const FrameSpan each : spans) sum += each.size();
  return sum;
}

/// Packs consecutive spans, as many as fit into each pack.
std::vector<FrameSpans> packed(FrameSpans spans, std::size_t together) {
  std::vector<FrameSpans> packs;
  for (std::size_t first = 0; first < spans.size();) {
    std::size_t count = 1;
    while (first + count < spans.size() && frames_in(spans.subspan(first, count + 1)) <= together) ++count;
    packs.push_back(spans.subspan(first, count));
    first += count;
  }
  return packs;
}

/// Returns the same number of packs, with nearly equal numbers of spans.
std::vector<FrameSpans> evened(FrameSpans spans, std::size_t packs) {
  std::vector<FrameSpans> even;
  for (std::size_t i = 0; i < packs; ++i) {
    const std::size_t begin = i * spans.size() / packs, end = (i + 1) * spans.size() / packs;
    even.push_back(spans.subspan(begin, end - begin));
  }
  return even;
}

FrameList ascending(FrameSpans spans) {
  FrameList frames;
  for (const FrameSpan each : spans) frames.insert(frames.end(), each.begin(), each.end());
  std::sort(frames.begin(), frames.end());
  return frames;
}

}  // namespace

FrameList Places::going_on() const {
  FrameList going_on;
  for (std::size_t j = 0; j < frames.size(); ++j)
    if (!given_up.contains(static_cast<Frame>(j))) going_on.push_back(frames[j]);
  return going_on;
}

FrameIntervals::FrameIntervals(const SceneDescription& scene, const FrameList& frames) : file_(scene.frames) {
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
  FrameList sorted = frames;
  std::stable_sort(sorted.begin(), sorted.end(), [&](FileFrame a, FileFrame b) {
    for (const Factor& factor : factors_)
      if (const int x = place_along(factor, file_, a), y = place_along(factor, file_, b); x != y) return x < y;
    return false;
  });
  std::map<const PluginUse*, std::size_t> places;
  for (const FileFrame frame : sorted) {
    const auto place = places.try_emplace(scene.own_integrator_of(frame), groups_.size()).first->second;
    if (place == groups_.size()) groups_.emplace_back();
    groups_[place].push_back(frame);
  }
}

std::vector<FrameSpan> FrameIntervals::blocks(FrameSpan frames, std::size_t factor) const {
  std::vector<FrameSpan> result;
  const auto place = [&](std::size_t i) { return place_along(factors_[factor], file_, frames[i]); };
  for (std::size_t first = 0, end = 0; first < frames.size(); first = end) {
    while (end < frames.size() && place(end) == place(first)) ++end;
    result.push_back(frames.subspan(first, end - first));
  }
  return result;
}

void FrameIntervals::cut(FrameSpan frames, std::size_t factor, std::size_t together,
                         std::vector<FrameList>& intervals) const {
  const std::vector<FrameSpan> spans = blocks(frames, factor);
  if (std::any_of(spans.begin(), spans.end(), [&](const FrameSpan& each) { return each.size() > together; })) {
    for (const FrameSpan& each : spans) cut(each, factor + 1, together, intervals);
    return;
  }
  std::vector<FrameSpans> packs = packed(spans, together);
  const std::vector<FrameSpans> even = evened(spans, packs.size());
  if (std::all_of(even.begin(), even.end(), [&](FrameSpans each) { return frames_in(each) <= together; })) packs = even;
  for (const FrameSpans& pack : packs) intervals.push_back(ascending(pack));
}

std::vector<FrameList> FrameIntervals::deal(int machines) const {
  int frames = 0;
  for (const FrameList& group : groups_) frames += static_cast<int>(group.size());
  const auto most = static_cast<std::size_t>(machines);
  int together = (frames + machines - 1) / machines;
  while (together < frames && cut(together).size() > most) ++together;
  std::vector<FrameList> intervals = cut(together);
  for (std::size_t i = most; i < intervals.size(); ++i) {
    FrameList& to = intervals[i % most];
    to.insert(to.end(), intervals[i].begin(), intervals[i].end());
  }
  intervals.resize(std::min(intervals.size(), most));
  for (FrameList& each : intervals) std::sort(each.begin(), each.end());
  return intervals;
}

std::vector<FrameList> FrameIntervals::cut(int together) const {
  std::vector<FrameList> intervals;
  for (const FrameList& group : groups_) cut(group, 0, static_cast<std::size_t>(together), intervals);
  std::sort(intervals.begin(), intervals.end());
  return intervals;
}

}  // namespace dspm
