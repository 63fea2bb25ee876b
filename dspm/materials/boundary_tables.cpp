#include "dspm/materials/boundary_tables.h"

#include <cmath>

#include "dspm/materials/facet_albedo.h"
#include "dspm/math/vec.h"

namespace dspm {
namespace {

constexpr float kStepsPerUnit = 20;  // of the index of refraction
constexpr float kFirstStep = 21;     // before, total reflection has its onset close to the horizon

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

bool is_a_step(float steps) { return steps < kFirstStep || std::abs(steps - std::round(steps)) < 1e-3f; }

}  // namespace

std::shared_ptr<const BoundaryTables> boundary_tables(float eta) {
  static MadeOnce<BoundaryTables> tables;
  const float steps = eta * kStepsPerUnit;
  if (is_a_step(steps)) return tables.of(eta, tables_of);
  const auto at = [](float step) { return tables.of(step / kStepsPerUnit, tables_of); };
  const auto a = at(std::floor(steps)), b = at(std::ceil(steps));
  return tables.of(eta, [&](float) {
    const float share = steps - std::floor(steps);
    return BoundaryTables{between(a->outside, b->outside, share), between(a->inside, b->inside, share)};
  });
}

}  // namespace dspm
