#include "dspm/integrators/visible_points.h"

#include <algorithm>
#include <cmath>

#include "dspm/math/vec.h"

namespace dspm {

VisiblePoints::VisiblePoints(std::span<const HitPointTile> tiles, std::vector<HitPoint> HitPointTile::*which,
                             float scale, float most, std::size_t step) {
  std::map<int, OneSize> by_size;
  std::size_t number = 0;
  for (const HitPointTile& tile : tiles)
    for (const HitPoint& hit : tile.*which) {
      if (number++ % step != 0) continue;
      const float radius = std::min(scale * hit.radius, most);
      OneSize& size = by_size[std::ilogb(radius)];
      size.points.push_back({&hit, &tile, radius * radius});
      size.most2 = std::max(size.most2, radius * radius);
    }
  std::vector<Vec3> places;
  for (auto& [exponent, size] : by_size) {
    places.clear();
    for (const Point& point : size.points) places.push_back(point.hit->p);
    size.grid.build(places, std::sqrt(size.most2));
    sizes_.push_back(std::move(size));
  }
}

}  // namespace dspm
