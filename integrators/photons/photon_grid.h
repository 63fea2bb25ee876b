// Photons, or other values with a place, sorted by position, ready for gathering.
#pragma once

#include <cstdint>

#include "dspm/base/grid/buffer.h"
#include "dspm/base/grid/point_grid.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/photons/plain_photon_map.h"
#include "dspm/integrators/transport/shape_face.h"

namespace dspm {

/// Photons of a cell keep their input order.
template <class Gathered>
class PhotonGrid {
 public:
  /// The details of a photon that few gathers ask for.
  class Details {
   public:
    Details(const PhotonGrid& grid, std::uint32_t place) : grid_(grid), place_(place) {}
    const Vec3& p() const { return grid_.points_[grid_.grid_.order()[place_]]; }
    ShapeFace face() const { return grid_.faces_[place_]; }
    /// The group of its light; there is one only if the grid was built with groups.
    int group() const { return grid_.groups_[place_]; }

   private:
    const PhotonGrid& grid_;
    std::uint32_t place_;
  };

  /// Builds the grid from `count` photons: photon(i) is the i-th, gathered(i) the data kept of it. `cell_size` should
  /// suit a typical search radius. `groups` are those that details can tell apart, or null.
  template <class PhotonOf, class GatheredOf>
  void build(std::size_t count, float cell_size, PhotonOf&& photon, GatheredOf&& gathered,
             const LightGroups* groups = nullptr);

  std::size_t bytes() const {
    return grid_.bytes() + photons_.bytes() + points_.bytes() + faces_.bytes() + groups_.bytes();
  }
  /// Returns the same grid for a device; this must outlive it, and be built no more.
  PlainPhotonGrid plain() const { return {grid_.plain(), photons_.data(), faces_.data()}; }
  /// Calls fn(const Gathered&, distance squared, const Details&) for every photon within sqrt(radius2) of p; returns
  /// how many it tested.
  template <class Fn>
  std::uint64_t for_each_within(const Vec3& p, float radius2, Fn&& fn) const {
    const Gathered* photons = photons_.data();
    return grid_.for_each_within(p, radius2, [&fn, photons, this](std::uint32_t i, float distance2) {
      fn(photons[i], distance2, Details(*this, i));
    });
  }

 private:
  PointGrid grid_;
  Buffer<Gathered> photons_;
  Buffer<Vec3> points_;  // in the order of the input
  Buffer<ShapeFace> faces_;
  Buffer<std::int32_t> groups_;  // of lights, by photon; empty if they are not told apart
};

template <class Gathered>
template <class PhotonOf, class GatheredOf>
void PhotonGrid<Gathered>::build(std::size_t count, float cell_size, PhotonOf&& photon, GatheredOf&& gathered,
                                 const LightGroups* groups) {
  constexpr std::int64_t kGrain = 1 << 14;
  const auto photons = static_cast<std::int64_t>(count);
  points_.refit(count);
  parallel_for(photons, kGrain, [&](std::int64_t number) {
    const auto i = static_cast<std::size_t>(number);
    points_[i] = photon(i).p;
  });
  grid_.build(points_, cell_size);
  photons_.refit(count);
  faces_.refit(count);
  groups_.refit(groups != nullptr ? count : 0);
  parallel_for(photons, kGrain, [&](std::int64_t place) {
    const auto i = static_cast<std::size_t>(place);
    photons_[i] = gathered(grid_.order()[i]);
    faces_[i] = photon(grid_.order()[i]).face;
    if (groups != nullptr) groups_[i] = groups->of_light(photon(grid_.order()[i]).light);
  });
}

}  // namespace dspm
