// The two lobes of a boundary that transmits light, and the choice between them.
#pragma once

#include "dspm/materials/bsdf.h"

namespace dspm {

inline constexpr LobeSet kReflection = 1, kTransmission = 2, kBothLobes = 3;

/// The probability of choosing reflection out of `lobes` if the boundary reflects `reflectance` and transmits the rest.
constexpr float chance_of_reflection(float reflectance, LobeSet lobes) {
  const LobeSet known = lobes & kBothLobes;
  return known == kBothLobes ? reflectance : known == kReflection ? 1.f : 0.f;
}

/// Returns the lobe probability of `lobes`.
constexpr float share_of(float reflectance, LobeSet lobes) {
  return (lobes & kReflection ? reflectance : 0) + (lobes & kTransmission ? 1 - reflectance : 0);
}

}  // namespace dspm
