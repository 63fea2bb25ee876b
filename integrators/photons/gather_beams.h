// The light that photons in media scatter along camera beams.
#pragma once

#include <array>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/photons/hit_point_tile.h"
#include "dspm/integrators/photons/medium_photons.h"

namespace dspm {

/// Calls fn(FrameSet, radiance) with what the photons around the beam send along its camera path, per emitted photon path;
/// the sets are disjoint, and frames without photons are left out. `scale` is that of the iteration's radii. Only photons of
/// wanted(light) count.
template <class Wanted, class Fn>
void gather_beam(const CameraBeam& beam, const HitPointTile& tile, const MediumPhotons& photons, float scale,
                 GatherCounts& counts, Wanted&& wanted, Fn&& fn) {
  counts.gathers.add(beam.frames.count());
  SharedCount within;
  Spectrum shared;
  std::array<Spectrum, kMaxFrames> own;
  FrameSet with_shared, with_own;
  const MediumSection section = tile.section_of(beam);
  const auto add = [&](FrameSet frames, const Spectrum& radiance) {
    if (frames == beam.frames) return with_shared = frames, static_cast<void>(shared += radiance);
    (frames - with_own).for_each([&](Frame f) { own[static_cast<std::size_t>(f)] = {}; });
    with_own |= frames;
    frames.for_each([&](Frame f) { own[static_cast<std::size_t>(f)] += radiance; });
  };
  counts.tests += photons.for_each_along(beam, scale, [&](const auto& found, float distance, float radius2) {
    const MediumPhoton& photon = *found.photon;
    const FrameSet frames = photon.frames & beam.frames;
    within.add(frames.count());
    if (frames.empty() || !wanted(photon.light)) return;
    const float phase = photon.phase.pdf_w(photon.w, -beam.ray.direction);
    const Spectrum radiance = photon.flux * hue_of_found(photon.only_nm, beam.is_alone) * section.left_at(distance) *
                              (phase / kernel_size(radius2));
    for_each_strand(found.strands, frames,
                    [&](FrameSet alike, const Spectrum& weight) { add(alike, radiance * weight); });
  });
  counts.found += within;
  for_each_strand(tile.strands.of(beam.strands), with_shared | with_own, [&](FrameSet alike, const Spectrum& weight) {
    const Spectrum factor = beam.throughput * weight;
    if (const FrameSet others = (alike & with_shared) - with_own; !others.empty()) fn(others, shared * factor);
    (alike & with_own).for_each([&](Frame f) {
      fn(FrameSet::single(f), (shared + own[static_cast<std::size_t>(f)]) * factor);
    });
  });
}

/// Calls fn(FrameSet, radiance, group) with what each group of lights brings of that, and what of it is `of_media`.
template <class Fn>
void gather_beam_by_group(const CameraBeam& beam, const HitPointTile& tile, const MediumPhotons& photons, float scale,
                          const LightGroups& groups, Fn&& fn) {
  GatherCounts not_counted;
  for (int group = 0; group < groups.count() && !beam.caught; ++group) {
    const bool all = beam.of_media && group == groups.of_media();
    gather_beam(
        beam, tile, photons, scale, not_counted, [&](int light) { return all || groups.of_light(light) == group; },
        [&](FrameSet frames, const Spectrum& radiance) { fn(frames, radiance, group); });
  }
}

}  // namespace dspm
