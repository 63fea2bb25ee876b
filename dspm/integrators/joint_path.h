// Frames that are scattered alike by surfaces that differ stay one path, with strands.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/path_step.h"
#include "dspm/math/frame_array.h"
#include "dspm/math/frames.h"

namespace dspm {

/// How some frames of a path are scattered.
struct Scattered {
  FrameSet frames;
  Rgb factor;
  BsdfSample sample;
  bool rough;  // a rough lobe was chosen

  std::optional<Rgb> along(const Scattered& first) const {
    const BsdfSample& s = first.sample;
    const bool same = sample.wi == s.wi && sample.specular == s.specular && sample.eta_scale == s.eta_scale;
    return same && rough == first.rough ? std::optional(factor) : std::nullopt;
  }
};

/// Calls fn(const Item&, std::span<const FrameFactor>) for each set of items that can be one, with the first of them
/// and the factors of all; for each item alone unless they are to `join`. An item has `frames`, and along(first) gives
/// its factor if it can go along with `first`, itself included.
template <class Item, class Fn>
void for_each_joint(const FrameArray<Item>& items, bool join, Fn&& fn) {
  std::uint64_t joined = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if ((joined >> i & 1) != 0) continue;
    FrameArray<FrameFactor> parts;
    parts.add({items[i].frames, *items[i].along(items[i])});
    for (std::size_t j = i + 1; join && j < items.size(); ++j) {
      if ((joined >> j & 1) != 0) continue;
      const std::optional<Rgb> factor = items[j].along(items[i]);
      if (!factor) continue;
      joined |= std::uint64_t{1} << j;
      parts.add({items[j].frames, *factor});
    }
    fn(items[i], std::span<const FrameFactor>(parts));
  }
}

/// Multiplies what the path's frames carry by their factors and keeps what `left` makes of it, frame by frame.
template <class Left>
[[gnu::noinline]] bool multiply_strands(PathState& path, std::span<const FrameFactor> factors, StrandTable& table,
                                        Left&& left) {
  Strands next;
  for_each_strand(table.of(path.strands), path.frames, [&](FrameSet frames, const Rgb& weight) {
    const Rgb before = path.throughput * weight;
    for (const FrameFactor& f : factors) {
      const FrameSet common = frames & f.frames;
      if (common.empty()) continue;
      const Rgb after = left(StrandList{0}, common, before, before * f.factor);
      if (!is_black(after)) next.add(common, after);
    }
  });
  if (next.strands().empty()) return false;
  path.frames = next.frames();
  path.strands = table.add(next, path.throughput);
  return true;
}

/// Whether what is left of a throughput depends on how it changes, not on how large it is.
enum class ByRatio { no, yes };

/// Multiplies what the path's frames carry by their factors and keeps what `left` makes of it: black takes frames out
/// of the path, as frames without a factor are. left(weights, FrameSet, before, after) is asked once for frames that
/// carry the same; ByRatio::yes, once for all frames whose throughputs differ by the grey list `weights` only (0: they
/// do not). Returns whether there is anything left.
template <class Left>
bool multiply(PathState& path, std::span<const FrameFactor> factors, StrandTable& table, ByRatio by_ratio,
              Left&& left) {
  const Strand* list = table.of(path.strands);
  if (factors.size() > 1 || (list != nullptr && !(list->grey && by_ratio == ByRatio::yes)))
    return multiply_strands(path, factors, table, left);
  path.frames &= factors[0].frames;
  path.strands = table.folded(path.strands, path.frames, path.throughput);
  path.throughput = left(path.strands, path.frames, path.throughput, path.throughput * factors[0].factor);
  return !is_black(path.throughput);
}

/// For multiply().
inline Rgb keep_all(StrandList, FrameSet, const Rgb&, const Rgb& after) { return after; }

}  // namespace dspm
