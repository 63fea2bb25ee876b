#include "dspm/materials/boundary_tables.h"

#include "dspm/materials/facet_albedo.h"
#include "dspm/math/vec.h"

namespace dspm {
namespace {

float refracted_by_facets(float cos, float alpha, float eta) {
  const Vec3 o = direction_of_cosine(cos);
  const Ggx facets({alpha, alpha});
  return mean_over_facets(facets, o, [&](const Vec3& m) {
    const auto i = refract(o, m, eta);
    return i && i->z < 0 ? (1 - fresnel_dielectric(dot(o, m), eta)) * facets.visible_after(o, *i) : 0.f;
  });
}

BoundaryAlbedos albedos_of(float eta) {
  const AlbedoTable mirrored([&](float cos, float alpha) { return reflected_by_boundary(cos, alpha, eta); });
  return {mirrored, AlbedoTable([&](float cos, float alpha) {
            return mirrored.of(cos, alpha) + refracted_by_facets(cos, alpha, eta);
          })};
}

}  // namespace

std::shared_ptr<const BoundaryTables> boundary_tables(float eta) {
  static MadeOnce<BoundaryTables> tables;
  return tables.of(eta, [](float index) { return BoundaryTables{albedos_of(index), albedos_of(1 / index)}; });
}

}  // namespace dspm
