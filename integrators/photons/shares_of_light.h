// How photons and camera paths share the light: settings of both for each way.
#pragma once

#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"

namespace dspm {

/// Ends paths where a rough lobe would scatter them.
inline PhotonSettings without_diffuse(PhotonSettings photon) {
  photon.kinds &= ~static_cast<unsigned>(kDiffusePhotons);
  return photon;
}
inline PhotonSettings caustics_alone(PhotonSettings photon) {
  photon.kinds = kCausticPhotons;
  return photon;
}
inline HitPointSettings going_on(HitPointSettings hit_point) {
  hit_point.go_on = true;
  return hit_point;
}
/// Camera paths that end nowhere and find what `path` does.
inline HitPointSettings finding_all(HitPointSettings hit_point) {
  hit_point.least_alpha = kNothingGathers, hit_point.go_on = false;
  return hit_point;
}

}  // namespace dspm
