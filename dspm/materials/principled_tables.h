// The directional albedos of the lobes of the principled material, which all its points share.
#pragma once

#include <memory>

#include "dspm/materials/albedo_table.h"
#include "dspm/materials/boundary_tables.h"

namespace dspm {

/// Of all lobes that do not depend on the index of refraction.
struct CommonAlbedos {
  AlbedoTable metal;  // of reflectance 1
  AlbedoTable coat;   // of index kCoatEta
  AlbedoTable sheen;  // white
};

inline constexpr float kCoatEta = 1.5f;

/// What all points of a material share.
struct PrincipledTables {
  float eta;  // index of refraction inside over outside
  bool thin;  // a wall without a body
  std::shared_ptr<const BoundaryTables> boundary;
  const CommonAlbedos& common;
};

/// Made once for each index, as long as somebody holds it; for many threads.
std::shared_ptr<const PrincipledTables> principled_tables(float eta, bool thin);

}  // namespace dspm
