// Computes what a file's photons are worth to each of its frames. Photon paths choose lights, and starting points for
// lights infinitely far away, to suit all frames of the file.
#pragma once

#include <vector>

#include "dspm/world/lighting/bounding_sphere.h"
#include "dspm/world/lighting/light_choices.h"
#include "dspm/world/lighting/lighting.h"
#include "dspm/world/objects/geometry.h"

namespace dspm {

/// The worth for one frame; both numbers are 1 in a file that holds this frame alone.
struct PhotonWorth {
  /// The flux of the frame's lights is as noisy as with this fraction of the photons in a file of its own.
  double by_choice = 1;
  /// The fraction of photons from infinitely far that enter the sphere around what is in the frame.
  double by_reach = 1;
};

/// Returns the worth for each frame of the file that has this sphere and these choices.
std::vector<PhotonWorth> photon_worth(const Geometry& geometry, const std::vector<WorldLight>& lights,
                                      const LightChoices& choices, const BoundingSphere& sphere);

}  // namespace dspm
