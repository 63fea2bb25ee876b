// Photons sorted by place, ready to be gathered.
#pragma once

#include <span>
#include <vector>

#include "core/rgb_lanes.h"
#include "integrators/photon.h"
#include "integrators/point_grid.h"

namespace dspm {

/// Photons of a cell keep the order in which they are given.
class PhotonGrid {
 public:
  /// What a gather needs of a photon besides its place: half a cache line. Four lanes are read where three are meant;
  /// nobody looks at the fourth, bytes of the next member.
  struct alignas(32) Gathered {
    Vec3 wi;
    Rgb flux;
    FrameSet frames;

    __m128 wi_lanes() const { return _mm_load_ps(&wi.x); }
    RgbLanes flux_lanes() const { return RgbLanes(_mm_loadu_ps(&flux.r)); }
  };

  /// `cell_size` suits a typical search radius.
  void build(std::span<const Photon* const> photons, float cell_size);

  std::size_t bytes() const;
  /// Calls fn(const Gathered&, distance squared) for every photon within sqrt(radius2) of p; returns how many were
  /// tested.
  template <class Fn>
  std::uint64_t for_each_within(const Vec3& p, float radius2, Fn&& fn) const {
    const Gathered* photons = photons_.data();
    return grid_.for_each_within(p, radius2,
                                 [&fn, photons](std::uint32_t i, float distance2) { fn(photons[i], distance2); });
  }

 private:
  PointGrid grid_;
  std::vector<Gathered> photons_;
  std::vector<Vec3> points_;
};

}  // namespace dspm
