// The contribution of one photon to one hit point: the inner loop of every photon gather. It tests distance (in the
// grid), frames, the side of the surface, and then the scattering function.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/rgb_lanes.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/hit_point.h"
#include "dspm/integrators/photons/photon_map.h"
#include "dspm/integrators/photons/surface_kernel.h"
#include "dspm/integrators/transport/light_value.h"

namespace dspm {

/// The work of gathers: points, photons found, and distance tests.
struct GatherCounts {
  SharedCount gathers, found;
  std::uint64_t tests = 0;
  Rejections rejections;
};

/// Calls fn(strands, frames, flux times f as RgbLanes, distance squared, group) for every photon within sqrt(radius2)
/// that counts for the hit point in some frame: photons arriving at the back of the surface do not, unless its lobes
/// transmit, and then only those of the same surface. The caller applies the throughput and the photon's strands, which
/// are mostly null. For group(), see PhotonMap.
template <class Fn>
void gather_by_group(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map, float radius2,
                     GatherCounts& counts, Fn&& fn) {
  counts.gathers.add(hit.frames.count());
  SharedCount within;
  if (!scattering) {  // separate, since most gather time is spent in this loop
    const SurfaceSide side(hit);
    counts.tests +=
        map.for_each_within(hit.p, radius2, hit.frames, [&](const auto& photon, float distance2, const auto& details) {
          const FrameSet frames = photon.frames & hit.frames;
          within.add(frames.count());
          if (!frames.empty() && side.counts(photon))
            fn(strands_of(photon), frames, photon.flux_lanes(), distance2, [&] { return details.group(); });
        });
  } else {
    const SameSurface surface(hit, *scattering, std::sqrt(radius2));
    counts.tests +=
        map.for_each_within(hit.p, radius2, hit.frames, [&](const auto& photon, float distance2, const auto& details) {
          const FrameSet frames = photon.frames & hit.frames;
          within.add(frames.count());
          if (frames.empty()) return;
          if (scattering->transmits ? !surface.counts(details.p(), photon.wi, details.face())
                                    : !(dot(photon.wi, hit.ng) > 0))
            return;
          const Rgb flux = photon.flux * scattering->scattered(photon.wi);
          if (!is_light(flux))
            counts.rejections.add({SceneElement::Kind::material, scattering->material}, frames, hit.pixel);
          fn(strands_of(photon), frames, RgbLanes(is_light(flux) ? flux : Rgb()), distance2,
             [&] { return details.group(); });
        });
  }
  counts.found += within;
}

/// Calls fn without the group; otherwise the same as gather_by_group().
template <class Fn>
void gather(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map, float radius2,
            GatherCounts& counts, Fn&& fn) {
  gather_by_group(hit, scattering, map, radius2, counts,
                  [&fn](const Strand* strands, FrameSet frames, RgbLanes flux, float distance2, auto) {
                    fn(strands, frames, flux, distance2);
                  });
}

/// Adds the counts of all tiles to `statistics`.
inline void account(const std::vector<GatherCounts>& tiles, Statistics& statistics) {
  for (const GatherCounts& c : tiles) {
    statistics.gathers += c.gathers, statistics.photon_tests += c.tests, statistics.photons_found += c.found;
    statistics.rejections += c.rejections;
  }
}

}  // namespace dspm
