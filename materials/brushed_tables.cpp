#include "dspm/materials/brushed_tables.h"

#include "dspm/base/math/vec.h"
#include "dspm/materials/facet_albedo.h"
#include "dspm/materials/fresnel.h"
#include "dspm/materials/made_once.h"

namespace dspm {
namespace {

float mirrored(const Ggx& facets, const Vec3& o, const Vec3& m, float eta) {
  return reflected_by_facet(facets, o, m, [&](float cos) { return fresnel_dielectric(cos, eta); });
}
BrushedAlbedo all_by_glass(float eta) {
  return brushed_mean([&](const Ggx& facets, const Vec3& o, const Vec3& m) {
    return mirrored(facets, o, m, eta) + refracted_by_facet(facets, o, m, eta);
  });
}

}  // namespace

std::shared_ptr<const BrushedAlbedo> brushed_dielectric(float eta) {
  static MadeOnce<BrushedAlbedo> made;
  return made_for_index(
      made, eta,
      [](float index) {
        return brushed_mean(
            [&](const Ggx& facets, const Vec3& o, const Vec3& m) { return mirrored(facets, o, m, index); });
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
