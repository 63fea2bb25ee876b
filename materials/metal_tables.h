// The albedos of facets of reflectance 1, each table made when a material first needs it.
#pragma once

#include "dspm/materials/albedo_table.h"
#include "dspm/materials/brushed_albedo.h"

namespace dspm {

const AlbedoTable& even_metal();
const BrushedAlbedo& brushed_metal();

struct MetalTables {
  const AlbedoTable* even = nullptr;
  const BrushedAlbedo* brushed = nullptr;  // null: all facets are equally rough in both directions

  /// See plain_copy.h.
  template <class Fn>
  constexpr void each_array(Fn&& fn) {
    fn(even, 1);
    fn(brushed, 1);
  }
};

}  // namespace dspm
