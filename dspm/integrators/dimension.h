// Which of a path's random numbers is for what.
#pragma once

namespace dspm {

/// The random numbers' dimensions at one bounce. A path's start takes the last three of bounce 0, so direct light at
/// the vertex of bounce b takes those of b + 1.
enum Dimension : int { kScatter, kLobe, kRoulette, kSplit, kLightChoice, kLightPoint, kLightDirection };

}  // namespace dspm
