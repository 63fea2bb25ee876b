// The directional albedos of the lobes of the principled material, which all its points share.
#pragma once

#include <memory>

#include "dspm/materials/albedo_table.h"
#include "dspm/materials/boundary_tables.h"
#include "dspm/materials/brushed_tables.h"
#include "dspm/materials/principled/layer_balance.h"

namespace dspm {

/// The albedos of all lobes that do not depend on the index of refraction.
struct CommonAlbedos {
  const AlbedoTable& metal;  // of reflectance 1
  AlbedoTable coat;          // of index kCoatEta
  AlbedoTable sheen;         // white
};

/// The shares of light that coat and sheen leave to facets below.
struct CommonBalances {
  LayerBalance coat, sheen;
};

/// The tables that a material needs.
struct PrincipledUses {
  bool brushed, glass, layers;
};

inline constexpr float kCoatEta = 1.5f;

/// The tables that all points of a material share.
struct PrincipledTables {
  float eta;        // index of refraction inside over outside
  bool thin;        // a wall without a body
  float film_eta;   // index of refraction of a thin film
  float film_gain;  // what such a film adds to what the dielectric mirrors, at most
  std::shared_ptr<const BoundaryTables> boundary;
  const CommonAlbedos& common;
  const CommonBalances* balances;      // null: no layers
  const BrushedAlbedo* brushed_metal;  // null: no brushed facets
  std::shared_ptr<const BrushedAlbedo> brushed_dielectric;
  std::shared_ptr<const BrushedGlass> brushed_glass;

  friend bool operator==(const PrincipledTables& a, const PrincipledTables& b) {
    return a.eta == b.eta && a.thin == b.thin && a.film_eta == b.film_eta;
  }
};

/// Returns the tables for many threads. What takes time is made once for each index.
PrincipledTables principled_tables(float eta, bool thin, float film_eta, const PrincipledUses& uses);

}  // namespace dspm
