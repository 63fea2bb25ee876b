#include "dspm/materials/principled/layer_balance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/facet_albedo.h"
#include "dspm/materials/microfacet.h"

namespace dspm {
namespace {

constexpr int kCosines = LayerBalance::kCosines;
using Row = LayerBalance::Row;

/// Returns elevations in steps of the cosine's root, so that they lie closer at grazing angles.
float cosine_of(std::size_t k) {
  const float x = (static_cast<float>(k) + 0.5f) / kCosines;
  return x * x;
}
std::size_t elevation_of(float cos) {
  return static_cast<std::size_t>(std::min(static_cast<int>(std::sqrt(cos) * kCosines), kCosines - 1));
}
/// Returns the share of diffuse light that leaves by this elevation.
float diffuse_share(std::size_t k) {
  const auto below = [](std::size_t i) { return rounded::pow(static_cast<float>(i) / kCosines, 4.f); };
  return below(k + 1) - below(k);
}

/// The light that white facets send from each elevation to each; all of it leaves.
class WhiteFacets {
 public:
  explicit WhiteFacets(float alpha) {
    const std::array<Row, kCosines> once = mirrored(Ggx({alpha, alpha}));
    Row lost;
    float mean_lost = 0;
    for (std::size_t o = 0; o < kCosines; ++o) {
      lost[o] = 1;
      for (std::size_t i = 0; i < kCosines; ++i) {
        // f is reciprocal, so both give it: the mean is reciprocal again.
        sent_[o][i] = (once[o][i] + once[i][o] * diffuse_share(i) / diffuse_share(o)) / 2;
        lost[o] -= sent_[o][i];
      }
      mean_lost += lost[o] * diffuse_share(o);
    }
    for (std::size_t o = 0; o < kCosines; ++o)
      for (std::size_t i = 0; i < kCosines; ++i)
        if (mean_lost > 1e-5f) sent_[o][i] += lost[o] * lost[i] * diffuse_share(i) / mean_lost;
  }

  /// Returns a under a layer that leaves `left`, by iteration.
  Row balance(const Row& left) const {
    Row a;
    for (std::size_t o = 0; o < kCosines; ++o) a[o] = std::sqrt(left[o]);
    for (int iteration = 0; iteration < 40; ++iteration) {
      const Row before = a;
      for (std::size_t o = 0; o < kCosines; ++o) {
        float passed = 0;
        for (std::size_t i = 0; i < kCosines; ++i) passed += sent_[o][i] * before[i];
        a[o] = std::sqrt(before[o] * left[o] / passed);
      }
    }
    return a;
  }

 private:
  /// Returns what single facets mirror.
  static std::array<Row, kCosines> mirrored(const Ggx& facets) {
    constexpr FacetRule kRule{12, 64, 0.5f};
    std::array<Row, kCosines> once{};
    for (std::size_t o = 0; o < kCosines; ++o) {
      const Vec3 from = direction_of_cosine(cosine_of(o));
      for_facets(facets, from, kRule, [&](const Vec3& m, float weight) {
        const Vec3 to = reflect(from, m);
        if (to.z > 0) once[o][elevation_of(to.z)] += weight * facets.visible_after(from, to);
      });
    }
    return once;
  }

  std::array<Row, kCosines> sent_;
};

}  // namespace

LayerBalance::LayerBalance(const AlbedoTable& layer) {
  for (int facet = 0; facet < kFacets; ++facet) {
    const WhiteFacets below(TablePlace::value(facet, kFacets));
    for (int above = 0; above < kLayers; ++above) {
      Row left;
      for (std::size_t k = 0; k < kCosines; ++k)
        left[k] = 1 - layer.of(cosine_of(k), TablePlace::value(above, kLayers));
      const Row a = below.balance(left);
      Row& row = mean_left_[static_cast<std::size_t>(facet)][static_cast<std::size_t>(above)];
      for (std::size_t k = 0; k < kCosines; ++k) row[k] = left[k] * left[k] / (a[k] * a[k]);
    }
  }
}

float LayerBalance::mean_left(float cos, float facet_alpha, float layer_alpha) const {
  const TablePlace facet(facet_alpha, kFacets), above(layer_alpha, kLayers);
  const float x = std::max(0.f, std::sqrt(cos) * kCosines - 0.5f);
  const auto k = static_cast<std::size_t>(std::min(static_cast<int>(x), kCosines - 2));
  const auto in_row = [&](int f, int a) {
    const Row& row = mean_left_[static_cast<std::size_t>(f)][static_cast<std::size_t>(a)];
    return row[k] + (x - static_cast<float>(k)) * (row[k + 1] - row[k]);
  };
  const auto at_facet = [&](int f) { return above.between(in_row(f, above.first), in_row(f, above.first + 1)); };
  return facet.between(at_facet(facet.first), at_facet(facet.first + 1));
}

}  // namespace dspm
