#include "dspm/integrators/guiding/visible_points.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"

namespace dspm {

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
      of_tiles[t][std::ilogb(radius)].push_back({&hits[place], &tiles[t], radius * radius});
    }
  });
  std::map<int, OneSize> by_size;
  for (const auto& of_tile : of_tiles)
    for (const auto& [exponent, points] : of_tile) {
      std::vector<Point>& all = by_size[exponent].points;
      all.insert(all.end(), points.begin(), points.end());
    }
  for (auto& [exponent, size] : by_size) sizes_.push_back(std::move(size));
  parallel_for(static_cast<std::int64_t>(sizes_.size()), 1, [&](std::int64_t i) {
    OneSize& size = sizes_[static_cast<std::size_t>(i)];
    std::vector<Vec3> places;
    for (const Point& point : size.points) {
      size.most2 = std::max(size.most2, point.radius2);
      places.push_back(point.hit->p);
    }
    size.grid.build(places, std::sqrt(size.most2));
  });
}

}  // namespace dspm
