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
  float eta;        // index of refraction inside over outside
  bool thin;        // a wall without a body
  float film_eta;   // index of refraction of a thin film
  float film_gain;  // what such a film adds to what the dielectric mirrors, at most
  std::shared_ptr<const BoundaryTables> boundary;
  const CommonAlbedos& common;

  friend bool operator==(const PrincipledTables& a, const PrincipledTables& b) {
    return a.eta == b.eta && a.thin == b.thin && a.film_eta == b.film_eta;
  }
};

/// What takes time is made once for each index; for many threads.
PrincipledTables principled_tables(float eta, bool thin, float film_eta);

}  // namespace dspm
