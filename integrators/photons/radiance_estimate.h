// The radiance due to the photons around a point, frame by frame: from the nearest of them, or from all within a
// radius.
#pragma once

#include <algorithm>
#include <vector>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/gather.h"

namespace dspm {

struct RadianceEstimate {
  int nearest = 100;         // photons; 0: all within the radius
  float radius = 0;          // maximum, or fixed, search radius in world units
  std::int64_t emitted = 0;  // photon paths in each frame
};

/// Calls fn(FrameSet, radiance times the hit point's throughput, group): with kNone for all photons, and with each of
/// the map's groups for the part of its photons within the same disc. A group's sets are disjoint and leave out frames
/// without photons. Frames that use the same photons share calls.
template <class Fn>
void estimate_radiance(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map,
                       const RadianceEstimate& how, GatherCounts& counts, Fn&& fn);

/// A photon found around a hit point.
struct NearPhoton {
  float distance2;
  int group;  // of lights; kNone: the map tells none apart
  FrameSet frames;
  Spectrum flux;  // times f
};

/// Returns the photons around `hit`, nearest first, until every frame has `how.nearest` of them or the radius ends.
std::vector<NearPhoton> near_photons(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map,
                                     const RadianceEstimate& how, GatherCounts& counts, float& radius);

template <class Fn>
void estimate_radiance(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map,
                       const RadianceEstimate& how, GatherCounts& counts, Fn&& fn) {
  float radius = how.radius;
  const std::vector<NearPhoton> photons = near_photons(hit, scattering, map, how, counts, radius);
  std::vector<Spectrum> parts(static_cast<std::size_t>(map.groups().count()));
  const auto sum = [&](FrameSet frames) {
    Spectrum flux;
    std::fill(parts.begin(), parts.end(), Spectrum());
    int found = 0;
    float radius2 = radius * radius;
    for (const NearPhoton& photon : photons) {
      if (!photon.frames.contains(frames)) continue;
      // The k-th photon only determines the disc's size. [Jensen 1996 counts it; without it the mean is unbiased]
      if (how.nearest > 0 && ++found == how.nearest) {
        radius2 = photon.distance2;
        break;
      }
      flux += photon.flux;
      if (photon.group != LightGroups::kNone) parts[static_cast<std::size_t>(photon.group)] += photon.flux;
    }
    if (is_black(flux) || radius2 == 0) return;
    const float size = kernel_size(radius2, static_cast<float>(how.emitted));
    fn(frames, hit.throughput * flux / size, LightGroups::kNone);
    for (std::size_t group = 0; group < parts.size(); ++group)
      if (!is_black(parts[group])) fn(frames, hit.throughput * parts[group] / size, static_cast<int>(group));
  };
  FrameSet alike = hit.frames;
  for (const NearPhoton& photon : photons) alike &= photon.frames;
  if (alike == hit.frames) return sum(hit.frames);
  hit.frames.for_each([&](Frame f) { sum(FrameSet::single(f)); });
}

}  // namespace dspm
