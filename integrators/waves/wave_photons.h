// Traces photons as trace_photons.h does, in waves: all paths of a range by one bounce after the other, by the step that a
// device takes (photon_wave.h). The photons are the same, bit for bit, but where paths of disjoint frames leave photons in
// another order.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/integrators/waves/plain_scene.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns what keeps the photons of these settings from being traced in waves, in words that follow "because"; empty if
/// nothing does.
std::string why_not_in_waves(const Scene& scene, const PhotonSettings& settings);

/// Does what trace_photons() does, for a scene and settings of which why_not_in_waves() says nothing; `plain` is the scene's.
/// With a `shuffle`, the paths of each wave are taken in a random order of that seed, as a device may take them.
std::vector<PhotonTrace> trace_photons_in_waves(const Scene& scene, const PlainScene& plain,
                                                const PhotonSettings& settings, std::uint64_t iteration,
                                                std::int64_t first, std::int64_t end, std::vector<PhotonTrace> reuse,
                                                std::uint64_t shuffle = 0);

}  // namespace dspm
