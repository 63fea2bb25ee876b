// The uses of a path's random numbers.
#pragma once

namespace dspm {

/// The dimensions of the random numbers at one bounce. A path's start uses those of bounce 0 from kLightChoice on, so
/// direct light at the vertex of bounce b uses those of b + 1; so does light that media scatter along the segment before.
enum Dimension : int {
  kScatter,
  kLobe,
  kRoulette,
  kSplit,
  kLightChoice,
  kLightPoint,
  kLightDirection,
  kNearLight,
  kScatteringPoint,
  kWavelength
};

}  // namespace dspm
