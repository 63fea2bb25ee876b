// Measures what photons find at a typical place, from the counts of the gathers that are made anyway.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dspm/base/math/median.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/statistics.h"

namespace dspm {

/// Counts what gathers find, by tile.
class FoundByTile {
 public:
  explicit FoundByTile(std::size_t tiles) : found_(tiles), gathers_(tiles) {}

  /// Call this after a gather at all hit points.
  void add(const std::vector<GatherCounts>& tiles) {
    ++rounds_;
    for (std::size_t t = 0; t < tiles.size(); ++t)
      found_[t] += tiles[t].found.separate, gathers_[t] += tiles[t].gathers.separate;
  }

  /// Takes the tiles of the last iteration; `shrunk` is their radius over their initial radius.
  TypicalHitPoint typical(const std::vector<HitPointTile>& tiles, const std::vector<double>& shrunk) const {
    std::vector<double> photons, radii;
    for (std::size_t t = 0; t < found_.size(); ++t) {
      if (found_[t] == 0) continue;
      photons.push_back(static_cast<double>(found_[t]) / static_cast<double>(gathers_[t]) * rounds_);
      if (!tiles[t].hit_points.empty())
        radii.push_back(shrunk[t] * tiles[t].radii_in_pixels / static_cast<double>(tiles[t].hit_points.size()));
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
};

}  // namespace dspm
