#include "dspm/materials/boundary_tables.h"

#include "dspm/base/math/vec.h"
#include "dspm/materials/facet_albedo.h"
#include "dspm/materials/made_once.h"

namespace dspm {
namespace {

float refracted_by_facets(float cos, float alpha, float eta) {
  const Vec3 o = direction_of_cosine(cos);
  const Ggx facets({alpha, alpha});
  return mean_over_facets(facets, o, [&](const Vec3& m) { return refracted_by_facet(facets, o, m, eta); });
}

BoundaryAlbedos albedos_of(float eta) {
  const AlbedoTable mirrored([&](float cos, float alpha) { return reflected_by_boundary(cos, alpha, eta); });
  return {mirrored, AlbedoTable([&](float cos, float alpha) {
            return mirrored.of(cos, alpha) + refracted_by_facets(cos, alpha, eta);
          })};
}

BoundaryTables tables_of(float eta) { return {albedos_of(eta), albedos_of(1 / eta)}; }

BoundaryAlbedos between(const BoundaryAlbedos& a, const BoundaryAlbedos& b, float share) {
  const auto mixed = [&](const AlbedoTable& x, const AlbedoTable& y) {
    return AlbedoTable([&](float cos, float alpha) {
      const float from = x.of(cos, alpha);
      return from + share * (y.of(cos, alpha) - from);
    });
  };
  return {mixed(a.reflected, b.reflected), mixed(a.reflected_or_refracted, b.reflected_or_refracted)};
}

}  // namespace

std::shared_ptr<const BoundaryTables> boundary_tables(float eta) {
  static MadeOnce<BoundaryTables> made;
  return made_for_index(made, eta, tables_of, [](const BoundaryTables& a, const BoundaryTables& b, float share) {
    return BoundaryTables{between(a.outside, b.outside, share), between(a.inside, b.inside, share)};
  });
}

}  // namespace dspm
