// Light that only photons bring to a glossy lobe: see docs/design.md, Photons and hit points. Such lobes extend camera
// paths, but no ray hits a light without extent, and no shadow ray reaches it through glass.
#pragma once

#include "dspm/colour/rgb.h"
#include "dspm/integrators/gather.h"
#include "dspm/integrators/kernel_size.h"
#include "dspm/math/frames.h"

namespace dspm {

/// Calls fn(FrameSet, radiance) with the radiance that the hidden photons within sqrt(radius2) of a glossy hit point
/// send along its camera path, per emitted photon path; the sets are disjoint and leave out frames without photons.
template <class Fn>
void gather_hidden(const HitPoint& hit, const HitPointTile& tile, const PhotonMap& hidden, float radius2,
                   GatherCounts& counts, Fn&& fn) {
  std::array<Rgb, kMaxFrames> flux;
  FrameSet lit;
  gather(hit, tile.scattering_of(hit), hidden, radius2, counts,
         [&](const Strand* strands, FrameSet frames, RgbLanes photon, float) {
           for_each_strand(strands, frames, [&](FrameSet alike, const Rgb& weight) {
             (alike - lit).for_each([&](Frame f) { flux[static_cast<std::size_t>(f)] = {}; });
             lit |= alike;
             alike.for_each([&](Frame f) { flux[static_cast<std::size_t>(f)] += photon.rgb() * weight; });
           });
         });
  const Rgb per_area = hit.throughput / kernel_size(radius2);
  for_each_strand(tile.strands.of(hit.strands), lit, [&](FrameSet alike, const Rgb& weight) {
    alike.for_each([&](Frame f) { fn(FrameSet::single(f), flux[static_cast<std::size_t>(f)] * per_area * weight); });
  });
}

}  // namespace dspm
