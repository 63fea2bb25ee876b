#include "dspm/materials/metal_tables.h"

#include "dspm/base/math/vec.h"
#include "dspm/materials/facet_albedo.h"

namespace dspm {

const AlbedoTable& even_metal() {
  static const AlbedoTable table(
      [](float cos, float alpha) { return reflected_by_facets(cos, alpha, [](float) { return 1.f; }); });
  return table;
}

const BrushedAlbedo& brushed_metal() {
  static const BrushedAlbedo table = brushed_mean([](const Ggx& facets, const Vec3& o, const Vec3& m) {
    return reflected_by_facet(facets, o, m, [](float) { return 1.f; });
  });
  return table;
}

}  // namespace dspm
