#include "dspm/materials/brushed_tables.h"

#include "dspm/materials/facet_albedo.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/made_once.h"
#include "dspm/math/vec.h"

namespace dspm {
namespace {

/// of_facet(facets, o, m): the share of light that facet m sends anywhere.
template <class Fn>
BrushedAlbedo mean_of(const Fn& of_facet) {
  return BrushedAlbedo([&](const Vec3& o, const Ggx& facets) {
    return mean_over_facets(facets, o, [&](const Vec3& m) { return of_facet(facets, o, m); }, {12, 20, 1});
  });
}

float mirrored(const Ggx& facets, const Vec3& o, const Vec3& m, float eta) {
  return reflected_by_facet(facets, o, m, [&](float cos) { return fresnel_dielectric(cos, eta); });
}
BrushedAlbedo all_by_glass(float eta) {
  return mean_of([&](const Ggx& facets, const Vec3& o, const Vec3& m) {
    return mirrored(facets, o, m, eta) + refracted_by_facet(facets, o, m, eta);
  });
}

}  // namespace

const BrushedAlbedo& brushed_metal() {
  static const BrushedAlbedo table = mean_of([](const Ggx& facets, const Vec3& o, const Vec3& m) {
    return reflected_by_facet(facets, o, m, [](float) { return 1.f; });
  });
  return table;
}

std::shared_ptr<const BrushedAlbedo> brushed_dielectric(float eta) {
  static MadeOnce<BrushedAlbedo> made;
  return made_for_index(
      made, eta,
      [](float index) {
        return mean_of([&](const Ggx& facets, const Vec3& o, const Vec3& m) { return mirrored(facets, o, m, index); });
      },
      [](const BrushedAlbedo& a, const BrushedAlbedo& b, float share) { return BrushedAlbedo(a, b, share); });
}

std::shared_ptr<const BrushedGlass> brushed_glass(float eta) {
  static MadeOnce<BrushedGlass> made;
  return made_for_index(
      made, eta,
      [](float index) {
        return BrushedGlass{all_by_glass(index), all_by_glass(1 / index)};
      },
      [](const BrushedGlass& a, const BrushedGlass& b, float share) {
        return BrushedGlass{BrushedAlbedo(a.outside, b.outside, share), BrushedAlbedo(a.inside, b.inside, share)};
      });
}

}  // namespace dspm
