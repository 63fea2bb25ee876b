// Frames whose surfaces differ but scatter alike stay one path, with strands.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frame_array.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/transport/path_step.h"

namespace dspm {

/// The way in which a path is scattered in some of its frames.
struct Scattered {
  FrameSet frames;
  Spectrum factor;
  BsdfSample sample;
  bool rough;  // a rough lobe was chosen

  std::optional<Spectrum> along(const Scattered& first) const {
    const BsdfSample& s = first.sample;
    const bool same = sample.wi == s.wi && sample.specular == s.specular && sample.eta_scale == s.eta_scale &&
                      sample.ahead == s.ahead && sample.by_wavelength == s.by_wavelength;
    // A camera path weighs the lights that it hits by the density; it only follows smooth lobes.
    const bool same_weights = rough || sample.pdf_w == s.pdf_w;
    return same && rough == first.rough && same_weights ? std::optional(factor) : std::nullopt;
  }
};

/// Calls fn(const Item&, std::span<const FrameFactor>) for each set of items that can be merged, with the first of them
/// and the factors of all; without `join`, for each item separately. An item has `frames`, and along(first) returns its
/// factor if it can be merged with `first`, which may be itself.
template <class Item, class Fn>
void for_each_joint(const FrameArray<Item>& items, bool join, Fn&& fn) {
  std::uint64_t joined = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if ((joined >> i & 1) != 0) continue;
    FrameArray<FrameFactor> factors;
    factors.add({items[i].frames, *items[i].along(items[i])});
    for (std::size_t j = i + 1; join && j < items.size(); ++j) {
      if ((joined >> j & 1) != 0) continue;
      const std::optional<Spectrum> factor = items[j].along(items[i]);
      if (!factor) continue;
      joined |= std::uint64_t{1} << j;
      factors.add({items[j].frames, *factor});
    }
    fn(items[i], std::span<const FrameFactor>(factors));
  }
}

/// The general case of multiply(), strand by strand.
template <class Left>
[[gnu::noinline]] bool multiply_strands(PathState& path, std::span<const FrameFactor> factors, StrandTable& table,
                                        Left&& left) {
  Strands next;
  for_each_strand(table.of(path.strands), path.frames, [&](FrameSet frames, const Spectrum& weight) {
    const Spectrum before = path.throughput * weight;
    for (const FrameFactor& f : factors) {
      const FrameSet common = frames & f.frames;
      if (common.empty()) continue;
      const Spectrum after = left(StrandList{0}, common, before, before * f.factor);
      if (!is_black(after)) next.add(common, after);
    }
  });
  if (next.strands().empty()) return false;
  path.frames = next.frames();
  path.strands = table.add(next, path.throughput);
  return true;
}

/// Says whether `left` depends only on the ratio of the throughputs before and after, not on their magnitude.
enum class ByRatio { no, yes };

/// Multiplies the throughputs of the path's frames by their factors and replaces them with the results of `left`.
/// Frames that become black or have no factor leave the path. left(weights, FrameSet, before, after) is called once for
/// frames with the same throughput; with ByRatio::yes, once for all frames whose throughputs differ only by the grey
/// list `weights` (0: they do not differ). Returns whether any frames remain.
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

/// A `left` for multiply() that keeps all that remains.
inline Spectrum keep_all(StrandList, FrameSet, const Spectrum&, const Spectrum& after) { return after; }

}  // namespace dspm
