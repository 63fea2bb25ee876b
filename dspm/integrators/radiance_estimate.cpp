#include "dspm/integrators/radiance_estimate.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "dspm/math/frames.h"

namespace dspm {
namespace {

bool enough_for_all(const std::vector<NearPhoton>& photons, FrameSet frames, int wanted) {
  std::array<int, kMaxFrames> found{};
  for (const NearPhoton& photon : photons)
    photon.frames.for_each([&](Frame f) { ++found[static_cast<std::size_t>(f)]; });
  bool enough = true;
  frames.for_each([&](Frame f) { enough &= found[static_cast<std::size_t>(f)] >= wanted; });
  return enough;
}

}  // namespace

// The radius doubles until it holds enough, so the k nearest are exact for any initial radius.
std::vector<NearPhoton> near_photons(const HitPoint& hit, const Scattering* scattering, const PhotonMap& map,
                                     const RadianceEstimate& how, GatherCounts& counts, float& radius) {
  std::vector<NearPhoton> photons;
  radius = how.nearest > 0 ? std::min(hit.radius, how.radius) : how.radius;
  while (true) {
    photons.clear();
    gather(hit, scattering, map, radius * radius, counts,
           [&](const Strand* strands, FrameSet frames, RgbLanes flux, float distance2) {
             assert(strands == nullptr && "paths that part have none");
             static_cast<void>(strands);
             photons.push_back({distance2, frames, flux.rgb()});
           });
    if (how.nearest == 0 || radius >= how.radius || enough_for_all(photons, hit.frames, how.nearest)) break;
    radius = std::min(2 * radius, how.radius);
  }
  if (how.nearest > 0)
    std::stable_sort(photons.begin(), photons.end(),
                     [](const NearPhoton& a, const NearPhoton& b) { return a.distance2 < b.distance2; });
  return photons;
}

}  // namespace dspm
