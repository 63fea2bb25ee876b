// The radiance due to the photons around a point, frame by frame: from the nearest of them, or from all within a
// radius.
#pragma once

#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/integrators/gather.h"
#include "dspm/integrators/kernel_size.h"
#include "dspm/math/frames.h"

namespace dspm {

struct RadianceEstimate {
  int nearest = 100;         // photons; 0: all within the radius
  float radius = 0;          // maximum, or fixed, search radius in world units
  std::int64_t emitted = 0;  // photon paths in each frame
};

/// Calls fn(FrameSet, radiance times the hit point's throughput, kNone); the sets are disjoint and leave out frames without
/// photons. Frames that use the same photons share one call. After it come those for its parts, by group of the map: what
/// the group's photons bring within the disc of all photons.
template <class Fn>
void estimate_radiance(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map,
                       const RadianceEstimate& how, GatherCounts& counts, Fn&& fn);

/// A photon found around a hit point.
struct NearPhoton {
  float distance2;
  int group;  // of lights; kNone: the map tells none apart
  FrameSet frames;
  Rgb flux;  // times f
};

/// The photons around `hit`, nearest first, until every frame has `how.nearest` of them or the radius ends.
std::vector<NearPhoton> near_photons(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map,
                                     const RadianceEstimate& how, GatherCounts& counts, float& radius);

template <class Fn>
void estimate_radiance(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map,
                       const RadianceEstimate& how, GatherCounts& counts, Fn&& fn) {
  float radius = how.radius;
  const std::vector<NearPhoton> photons = near_photons(hit, scattering, map, how, counts, radius);
  const auto sum = [&](FrameSet frames, int group) {
    Rgb flux;
    int found = 0;
    float radius2 = radius * radius;
    for (const NearPhoton& photon : photons) {
      if (!photon.frames.contains(frames)) continue;
      // The k-th photon only determines the disc's size. [Jensen 1996 counts it; without it the mean is unbiased]
      if (how.nearest > 0 && ++found == how.nearest) {
        radius2 = photon.distance2;
        break;
      }
      if (group == LightGroups::kNone || photon.group == group) flux += photon.flux;
    }
    if (is_black(flux) || radius2 == 0) return;
    fn(frames, hit.throughput * flux / kernel_size(radius2, static_cast<float>(how.emitted)), group);
  };
  const auto sums = [&](FrameSet frames) {
    for (int group = LightGroups::kNone; group < map.groups().count(); ++group) sum(frames, group);
  };
  FrameSet alike = hit.frames;
  for (const NearPhoton& photon : photons) alike &= photon.frames;
  if (alike == hit.frames) return sums(hit.frames);
  hit.frames.for_each([&](Frame f) { sums(FrameSet::single(f)); });
}

}  // namespace dspm
