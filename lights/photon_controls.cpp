#include "dspm/lights/photon_controls.h"

#include <cmath>

namespace dspm {

PhotonControls read_photon_controls(ParamReader& params) {
  PhotonControls controls;
  controls.photons = params.number(kPhotonsParam, 1, "", "factor to its share of the photon paths; it is no brighter");
  controls.caustics = params.flag(kCausticsParam, true,
                                  "false: its photons end where they would go on to a caustic, whose light is missing");
  if (!(controls.photons > 0) || !std::isfinite(controls.photons))
    params.error(kPhotonsParam, "photons must be above 0: without photons, light would be missing",
                 "\"float scale\" 0 turns a light off, \"bool caustics\" false takes its caustics out");
  return controls;
}

}  // namespace dspm
