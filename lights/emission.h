// What lights say of the light that they give: to photons that leave them, and to points that they illuminate.
#pragma once

#include <array>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// The densities with which emit() draws the start and the direction of a path. A delta counts as 1: all paths start at
/// one point, or all go in one direction.
struct EmissionPdf {
  /// The density by area, including the choice of the primitive: by area of the light's surface in the world or, if the
  /// light is infinitely far away, of the disk across the direction on which photons start.
  float position = 0;
  float direction = 0;  // by solid angle; if the light is infinitely far away, whatever the position
  bool delta_position = false, delta_direction = false;
};

/// The numbers that Light::emit takes: position x and y, direction x and y, each in [0, 1).
using EmissionNumbers = std::array<float, 4>;
/// Stands for a number that may be any, because emit() does not use it, or that is not known.
inline constexpr float kAnyNumber = -1;

/// A photon as it leaves the light. The mean of `flux` over all random numbers is the light's power; `flux` times both
/// densities is the radiance times |cos| to `normal`. Without a normal there is no cosine; for a delta, the radiant
/// intensity or the irradiance across the direction takes the place of radiance.
struct Emission {
  Ray ray;
  Rgb flux;
  EmissionPdf pdf = {};
  Vec3 normal = {};    // the geometric normal of the light's surface at the start; zero if it has no surface
  int primitive = -1;  // of the light's shape; -1 if it has none
  /// The photon carries nothing if it meets a surface before this length of its path: it starts before the window that
  /// the light must pass.
  float must_reach = 0;
};

/// Light that arrives at a point from one direction.
struct Illumination {
  Vec3 wi;           // towards the light
  float distance;    // infinite for distant and infinite lights
  Rgb radiance;      // for a delta light: the irradiance on a surface perpendicular to wi
  float pdf_w;       // by solid angle; 0 for a delta light (one that no ray can hit)
  Vec3 normal = {};  // of the light's surface at the sampled point, and its primitive: as in Emission
  int primitive = -1;
};

}  // namespace dspm
