// A photon map as a plain value that devices can have.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dspm/base/grid/grid_cells.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/photon.h"
#include "dspm/integrators/transport/shape_face.h"

namespace dspm {

struct PlainPhotonGrid {
  PlainGrid grid;
  const GatheredPhoton* photons = nullptr;
  const ShapeFace* faces = nullptr;

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    grid.each_array(fn);
    fn(photons, grid.point_count), fn(faces, grid.point_count);
  }
};

/// Up to this many frames are searched in grids of their own, one by one.
inline constexpr int kFewFrames = 3;

/// See PhotonMap, which has photons with strands as well.
struct PlainPhotonMap {
  PlainPhotonGrid common, single;
  const PlainPhotonGrid* of_frame = nullptr;  // null: `common` has all
  std::size_t frame_count = 0;                // that have a grid

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    common.each_array(fn), single.each_array(fn);
    fn(of_frame, frame_count);
  }

  /// Calls fn(const PlainPhotonGrid&, place) for each photon within sqrt(radius2) of p that exists in some of `frames`, and for
  /// some others, in the order of PhotonMap; returns how many it tested.
  template <class Fn>
  constexpr std::uint64_t for_each_within(const Vec3& p, float radius2, FrameSet frames, Fn&& fn) const {
    const auto search = [&](const PlainPhotonGrid& in) {
      return in.grid.for_each_within(p, radius2, [&](std::uint32_t place, float) { fn(in, place); });
    };
    std::uint64_t tested = search(common);
    if (frames.count() > kFewFrames)
      tested += search(single);
    else if (of_frame != nullptr)
      frames.for_each([&](Frame f) { tested += search(of_frame[f]); });
    return tested;
  }
};

}  // namespace dspm
