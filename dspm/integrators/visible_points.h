// The reverse of a photon map: hit points by position, to find those that would gather a given photon.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/grid/point_grid.h"
#include "dspm/integrators/hit_point.h"
#include "dspm/integrators/kernel_size.h"
#include "dspm/integrators/photon.h"
#include "dspm/math/frames.h"

namespace dspm {

class VisiblePoints {
 public:
  /// Every `step`-th of the tiles' hit points, with `scale` times their radius, but at most `most`. `which`: ordinary
  /// ones or those of glossy lobes. The tiles must outlive it.
  VisiblePoints(std::span<const HitPointTile> tiles, std::vector<HitPoint> HitPointTile::*which, float scale,
                float most, std::size_t step = 1);

  /// Calls fn(radiance, frames, const HitPoint&) for every point that gathers the photon: the luminance that its pixel
  /// gains in each of these frames. Strands do not count.
  template <class Fn>
  void for_each_gathering(const Photon& photon, Fn&& fn) const {
    for (const OneSize& size : sizes_)
      size.grid.for_each_within(photon.p, size.most2, [&](std::uint32_t i, float distance2) {
        const Point& point = size.points[size.grid.order()[i]];
        if (distance2 > point.radius2) return;
        const HitPoint& hit = *point.hit;
        const FrameSet frames = photon.frames & hit.frames;
        const Scattering* scattering = point.tile->scattering_of(hit);
        if (frames.empty()) return;
        if (!(dot(photon.wi, hit.ng) > 0) && !(scattering && scattering->transmits)) return;
        Rgb flux = photon.flux * hit.throughput;
        if (scattering)
          flux *= scattering->bsdf->evaluate(scattering->wo, photon.wi, Transport::radiance, scattering->lobes);
        const float radiance = luminance(flux) / kernel_size(point.radius2);
        if (radiance > 0 && std::isfinite(radiance)) fn(radiance, frames, hit);
      });
  }

 private:
  struct Point {
    const HitPoint* hit;
    const HitPointTile* tile;
    float radius2;
  };
  /// Points whose radii differ by less than a factor of two.
  struct OneSize {
    float most2 = 0;
    std::vector<Point> points;
    PointGrid grid;
  };
  std::vector<OneSize> sizes_;
};

}  // namespace dspm
