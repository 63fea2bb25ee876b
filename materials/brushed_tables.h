// The albedos of brushed boundaries, each made when a material first needs it.
#pragma once

#include <memory>

#include "dspm/materials/brushed_albedo.h"

namespace dspm {

/// The albedos of a boundary for light that is reflected or refracted.
struct BrushedGlass {
  BrushedAlbedo outside, inside;
};

/// Returns the albedos of what a boundary mirrors, from outside.
std::shared_ptr<const BrushedAlbedo> brushed_dielectric(float eta);
std::shared_ptr<const BrushedGlass> brushed_glass(float eta);

}  // namespace dspm
