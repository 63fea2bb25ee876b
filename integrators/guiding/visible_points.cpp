#include "dspm/integrators/guiding/visible_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/untouched.h"

namespace dspm {
namespace {

constexpr std::int64_t kPlacesAtOnce = 1 << 12;

}  // namespace

VisiblePoints::VisiblePoints(std::span<const HitPointTile> tiles, std::vector<HitPoint> HitPointTile::*which,
                             float scale, float most, std::size_t step, FrameSet frames) {
  std::vector<std::size_t> first(tiles.size());  // point of each tile
  for (std::size_t t = 1; t < tiles.size(); ++t) first[t] = first[t - 1] + (tiles[t - 1].*which).size();
  std::vector<std::map<int, std::vector<Point>>> of_tiles(tiles.size());
  parallel_for(static_cast<std::int64_t>(tiles.size()), 1, [&](std::int64_t i) {
    const auto t = static_cast<std::size_t>(i);
    const std::vector<HitPoint>& hits = tiles[t].*which;
    for (std::size_t place = (step - first[t] % step) % step; place < hits.size(); place += step) {
      if ((hits[place].frames & frames).empty()) continue;
      const float radius = std::min(scale * hits[place].radius, most);
      of_tiles[t][std::ilogb(radius)].push_back({&hits[place], &tiles[t], hits[place].frames, radius * radius});
    }
  });
  std::map<int, std::vector<std::size_t>> first_of_tile;  // by size: of each tile, and one past the last
  for (const auto& of_tile : of_tiles)
    for (const auto& [exponent, points] : of_tile) first_of_tile[exponent];
  for (auto& [exponent, firsts] : first_of_tile) {
    firsts.push_back(0);
    for (const auto& of_tile : of_tiles) {
      const auto found = of_tile.find(exponent);
      firsts.push_back(firsts.back() + (found == of_tile.end() ? 0 : found->second.size()));
    }
    sizes_.emplace_back().points.resize(firsts.back());
  }
  parallel_for(static_cast<std::int64_t>(tiles.size()), 1, [&](std::int64_t i) {
    const auto t = static_cast<std::size_t>(i);
    auto size = sizes_.begin();
    for (const auto& [exponent, firsts] : first_of_tile) {
      OneSize& of_size = *size++;
      if (const auto found = of_tiles[t].find(exponent); found != of_tiles[t].end())
        std::copy(found->second.begin(), found->second.end(), of_size.points.data() + firsts[t]);
    }
  });
  parallel_for(static_cast<std::int64_t>(sizes_.size()), 1, [&](std::int64_t i) {
    OneSize& size = sizes_[static_cast<std::size_t>(i)];
    UntouchedVector<Vec3> places(size.points.size());
    std::vector<float> most2(
        static_cast<std::size_t>(chunk_count(static_cast<std::int64_t>(places.size()), kPlacesAtOnce)));
    parallel_for(static_cast<std::int64_t>(places.size()), kPlacesAtOnce, [&](std::int64_t p) {
      const Point& point = size.points[static_cast<std::size_t>(p)];
      places[static_cast<std::size_t>(p)] = point.hit->p;
      float& largest = most2[static_cast<std::size_t>(p / kPlacesAtOnce)];
      largest = std::max(largest, point.radius2);
    });
    for (const float largest : most2) size.most2 = std::max(size.most2, largest);
    size.grid.build(places, std::sqrt(size.most2));
    UntouchedVector<Point> sorted(places.size());
    parallel_for(static_cast<std::int64_t>(places.size()), kPlacesAtOnce, [&](std::int64_t place) {
      const auto at = static_cast<std::size_t>(place);
      sorted[at] = size.points[size.grid.order()[at]];
    });
    size.points = std::move(sorted);
  });
}

}  // namespace dspm
