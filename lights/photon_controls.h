// Reads what a scene says about the photons of any light, for any plugin.
#pragma once

#include "dspm/base/params/params.h"

namespace dspm {

struct PhotonControls {
  float photons = 1;     // the factor to its share of the photon paths
  bool caustics = true;  // its photons go on along smooth lobes before they have met a rough one
};

inline constexpr const char* kPhotonsParam = "photons";
inline constexpr const char* kCausticsParam = "caustics";

/// Reads the controls. Call it before the light's own factory reads the rest.
PhotonControls read_photon_controls(ParamReader& params);

}  // namespace dspm
