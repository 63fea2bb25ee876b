// The directional albedos of a rough boundary between two media.
#pragma once

#include <memory>

#include "dspm/materials/albedo_table.h"

namespace dspm {

/// The albedos of the boundary as seen from one of its sides.
struct BoundaryAlbedos {
  AlbedoTable reflected, reflected_or_refracted;

  constexpr float refracted(float cos, float alpha) const {
    return std::max(0.f, reflected_or_refracted.of(cos, alpha) - reflected.of(cos, alpha));
  }
};

struct BoundaryTables {
  BoundaryAlbedos outside, inside;
};

/// Takes an index of refraction inside over outside. Above 1.05, tables are interpolated between multiples of 0.05:
/// each takes a fifteenth of a second, and animated indices are many. The means are within 0.001 outside and within
/// 0.002 inside, where the onset of total reflection is smeared.
std::shared_ptr<const BoundaryTables> boundary_tables(float eta);

}  // namespace dspm
