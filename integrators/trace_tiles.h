// One camera path through each pixel, by tracers that have a tile each.
#pragma once

#include <cstdint>
#include <vector>

#include "dspm/base/system/parallel.h"
#include "dspm/image/film/pixel_rect.h"
#include "dspm/integrators/moment_pixels.h"
#include "dspm/integrators/statistics.h"
#include "dspm/integrators/tiles.h"

namespace dspm {

/// Traces each tile's pixels that are among `pixels` with a tracer that make_tracer() returns, which has trace(x, y,
/// iteration), counts() and rejections(); these two are added to `statistics`.
template <class MakeTracer>
void trace_tiles(const PixelRect& crop, const MomentPixels& pixels, std::uint64_t iteration, Statistics& statistics,
                 MakeTracer&& make_tracer) {
  constexpr int kTileSide = 16;
  std::vector<Statistics> counts(static_cast<std::size_t>(tile_count(crop, kTileSide)));
  parallel_for(static_cast<std::int64_t>(counts.size()), 1, [&](std::int64_t t) {
    auto tracer = make_tracer();
    for_each_pixel_of_tile(crop, kTileSide, static_cast<int>(t), [&](int x, int y) {
      if (pixels.contain(x, y)) tracer.trace(x, y, iteration);
    });
    counts[static_cast<std::size_t>(t)].camera = tracer.counts();
    counts[static_cast<std::size_t>(t)].rejections = tracer.rejections();
  });
  for (const Statistics& c : counts) statistics.camera += c.camera, statistics.rejections += c.rejections;
}

}  // namespace dspm
