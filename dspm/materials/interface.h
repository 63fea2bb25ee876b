// The two lobes of a boundary that light may pass, and the choice between them.
#pragma once

#include "dspm/materials/bsdf.h"

namespace dspm {

inline constexpr LobeSet kReflection = 1, kTransmission = 2, kBothLobes = 3;

/// The chance that reflection is chosen out of `lobes`, where the boundary reflects `reflectance` and passes the rest.
inline float chance_of_reflection(float reflectance, LobeSet lobes) {
  const LobeSet known = lobes & kBothLobes;
  return known == kBothLobes ? reflectance : known == kReflection ? 1.f : 0.f;
}

/// The share of `lobes` in all that the boundary does.
inline float share_of(float reflectance, LobeSet lobes) {
  return (lobes & kReflection ? reflectance : 0) + (lobes & kTransmission ? 1 - reflectance : 0);
}

}  // namespace dspm
