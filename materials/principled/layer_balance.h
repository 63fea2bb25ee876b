// Balances what a layer leaves to facets below it, so that nothing is lost between them.
//
// A layer leaves X(o) of the light from o. Of what white facets send from o to i, a(o) a(i) passes the layer both ways,
// with a such that all that reaches them leaves again, now or after more reflections to and fro:
//   a(o) * integral of f(o, i) a(i) cos(i) = X(o),
// which is the scaling of a symmetric matrix to given sums of its rows. f is GGX with the diffuse lobe that makes up
// for what facets lose. In a = X / sqrt(M), M is X for mirrors, the mean of X for a diffuse base, and in between for
// rough facets. [Sinkhorn 1964, A Relationship Between Arbitrary Positive Matrices and Doubly Stochastic Matrices]
#pragma once

#include <array>

#include "dspm/materials/albedo_table.h"

namespace dspm {

class LayerBalance {
 public:
  static constexpr int kCosines = 32;
  using Row = std::array<float, kCosines>;

  /// `layer` holds what all of the layer sends back.
  explicit LayerBalance(const AlbedoTable& layer);

  /// Returns M under a share of the layer, to 0.3% of the light.
  float mean_left(float share, float cos, float facet_alpha, float layer_alpha) const {
    return 1 - share * (1 - mean_left(cos, facet_alpha, layer_alpha));
  }

 private:
  static constexpr int kFacets = 12, kLayers = 8;

  /// Interpolates linearly between the table's entries.
  float mean_left(float cos, float facet_alpha, float layer_alpha) const;

  std::array<std::array<Row, kLayers>, kFacets> mean_left_;
};

}  // namespace dspm
