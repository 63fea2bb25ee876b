#include "dspm/integrators/photons/radiance_estimate.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "dspm/base/math/frames.h"

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
  const bool has_groups = map.groups().count() > 0;
  std::vector<NearPhoton> photons;
  radius = how.nearest > 0 ? std::min(hit.radius, how.radius) : how.radius;
  while (true) {
    photons.clear();
    gather_by_group(
        hit, scattering, map, radius * radius, counts,
        [&](const Strand* strands, FrameSet frames, SpectrumLanes flux, float distance2, auto group) {
          assert(strands == nullptr && "paths that part have none");
          static_cast<void>(strands);
          photons.push_back({distance2, has_groups ? group() : LightGroups::kNone, frames, flux.spectrum()});
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
