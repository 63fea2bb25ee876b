// Measures what photons find at a typical place, from the radii and counts of the gathers that are made anyway.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dspm/base/math/median.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/statistics.h"

namespace dspm {

/// Sums by tile; the tiles are those of the iteration.
class TypicalHitPoints {
 public:
  explicit TypicalHitPoints(std::size_t tiles) : found_(tiles), gathers_(tiles), shrunk_(tiles) {}

  /// Returns the mean of the radii in which photons will be sought, which suits the cells of their map; 0 if there are
  /// no hit points. radius2(hit) returns their squares.
  template <class Radius2>
  double mean_radius(std::span<const HitPointTile> tiles, Radius2&& radius2) {
    std::vector<double> sums(tiles.size());
    parallel_for(static_cast<std::int64_t>(tiles.size()), 1, [&](std::int64_t tile) {
      const auto t = static_cast<std::size_t>(tile);
      double initial = 0;
      for (const HitPoint& hit : tiles[t].hit_points) {
        sums[t] += std::sqrt(static_cast<double>(radius2(hit)));
        initial += static_cast<double>(hit.radius);
      }
      shrunk_[t] = initial > 0 ? sums[t] / initial : 1;
    });
    double sum = 0, count = 0;
    for (std::size_t t = 0; t < tiles.size(); ++t)
      sum += sums[t], count += static_cast<double>(tiles[t].hit_points.size());
    return count > 0 ? sum / count : 0;
  }

  /// Call this after a gather at all hit points, or at a part of them that is not the first.
  void add(std::span<const GatherCounts> counts, bool is_first_part) {
    rounds_ += is_first_part;
    for (std::size_t t = 0; t < counts.size(); ++t)
      found_[t] += counts[t].found.separate, gathers_[t] += counts[t].gathers.separate;
  }

  TypicalHitPoint typical(std::span<const HitPointTile> tiles) const {
    std::vector<double> photons, radii;
    for (std::size_t t = 0; t < found_.size(); ++t) {
      if (found_[t] == 0) continue;
      photons.push_back(static_cast<double>(found_[t]) / static_cast<double>(gathers_[t]) * rounds_);
      if (!tiles[t].hit_points.empty())
        radii.push_back(shrunk_[t] * tiles[t].radii_in_pixels / static_cast<double>(tiles[t].hit_points.size()));
    }
    return {median(photons), median(radii)};
  }

  void persist(StateStream& state) {
    state.sum(rounds_);
    state.sum(found_);
    state.sum(gathers_);
  }

 private:
  int rounds_ = 0;
  std::vector<std::uint64_t> found_, gathers_;
  std::vector<double> shrunk_;  // radius over initial radius
};

}  // namespace dspm
