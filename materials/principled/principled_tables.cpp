#include "dspm/materials/principled/principled_tables.h"

#include <cmath>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/facet_albedo.h"
#include "dspm/materials/metal_tables.h"
#include "dspm/materials/principled/sheen.h"
#include "dspm/materials/thin_film.h"

namespace dspm {
namespace {

/// Integrates by a midpoint rule over wi's elevation, closer at the horizon, and half of the azimuths.
float albedo_of_sheen(float cos, float alpha) {
  constexpr int kUp = 48, kAround = 24;
  const Sheen sheen(alpha);
  double sum = 0;
  for (int i = 0; i < kUp; ++i) {
    const float x = (static_cast<float>(i) + 0.5f) / kUp, elevation = x * x * kPi / 2;
    const float z = rounded::sin(elevation), r = rounded::cos(elevation);
    for (int j = 0; j < kAround; ++j) {
      const float phi = (static_cast<float>(j) + 0.5f) / kAround * kPi;
      sum += static_cast<double>(sheen.f(direction_of_cosine(cos), {r * rounded::cos(phi), r * rounded::sin(phi), z}) *
                                 z * r * x);
    }
  }
  return static_cast<float>(2 * std::acos(-1.) * std::acos(-1.) * sum / (kUp * kAround));
}

const CommonAlbedos& common_albedos() {
  static const CommonAlbedos albedos{
      even_metal(), AlbedoTable([](float cos, float alpha) { return reflected_by_boundary(cos, alpha, kCoatEta); }),
      AlbedoTable(albedo_of_sheen)};
  return albedos;
}

const CommonBalances& common_balances() {
  static const CommonBalances balances{LayerBalance(common_albedos().coat), LayerBalance(common_albedos().sheen)};
  return balances;
}

}  // namespace

PrincipledTables principled_tables(float eta, bool thin, float film_eta, const PrincipledUses& uses) {
  PrincipledTables tables{eta,
                          thin,
                          film_eta,
                          ThinFilm::most_gain(film_eta, eta),
                          boundary_tables(eta),
                          common_albedos(),
                          uses.layers ? &common_balances() : nullptr,
                          uses.brushed ? &brushed_metal() : nullptr,
                          nullptr,
                          nullptr};
  if (uses.brushed) tables.brushed_dielectric = brushed_dielectric(eta);
  if (uses.brushed && uses.glass && !thin) tables.brushed_glass = brushed_glass(eta);
  return tables;
}

}  // namespace dspm
