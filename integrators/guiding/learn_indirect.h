// Learns who should find the light that rough surfaces throw on one another: photons, which need a surface full of
// them, or camera paths, which go on from hit points. Under a sky over a wide ground hardly a photon finds its way from
// the ground to what stands on it; in a room nearly all do.
#pragma once

#include <cstdint>

#include "dspm/integrators/integrator.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Ends paths where a rough lobe would scatter them.
inline PhotonSettings without_diffuse(PhotonSettings photon) {
  photon.kinds &= ~static_cast<unsigned>(kDiffusePhotons);
  return photon;
}
inline HitPointSettings going_on(HitPointSettings hit_point) {
  hit_point.go_on = true;
  return hit_point;
}

/// Returns whether, by pilot paths of both, camera paths that go on would have less variance than photons at equal
/// work. An iteration traces `photons` paths, drawn with the guides.
bool paths_that_go_on_pay(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                          const HitPointSettings& hit_point, std::int64_t photons, const EmissionGuides& guides);

}  // namespace dspm
