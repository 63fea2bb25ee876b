// Photons on surfaces that turn to each ray, by their place along them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "dspm/integrators/light_groups.h"
#include "dspm/integrators/photons/photon.h"
#include "dspm/integrators/transport/strand.h"
#include "dspm/integrators/transport/strip_place.h"

namespace dspm {

/// A photon on a surface that turns to each ray. Its flux includes no cosines.
struct CurvePhoton : Photon {
  StripPlace at;
  int bounces;  // scatterings before
};

class CurvePhotons {
 public:
  CurvePhotons() = default;
  /// Makes a list that tells the photons of these groups apart.
  explicit CurvePhotons(LightGroups groups) : groups_(std::move(groups)) {}

  /// Sorts the photons of all `traces`, which have `on_curves` and `strands` and must outlive this object.
  template <class Trace>
  void build(const std::vector<Trace>& traces) {
    sorted_.clear();
    for (const Trace& trace : traces)
      for (const CurvePhoton& photon : trace.on_curves) sorted_.push_back({&photon, trace.strands.of(photon.strands)});
    sort();
  }

  std::size_t size() const { return sorted_.size(); }
  std::size_t bytes() const { return sorted_.capacity() * sizeof(Placed); }

  /// Calls fn(const CurvePhoton&, const Strand*, irradiance per flux, group) for every photon that counts within
  /// `radius` of the place, in any frame; returns how many it tested. The irradiance is across the photon's beam; for
  /// group(), see PhotonMap.
  template <class Fn>
  std::uint64_t for_each_within(const StripPlace& seen, float radius, Fn&& fn) const {
    const StripKernel kernel(seen, radius);
    std::uint64_t tested = 0;
    for (std::size_t i = first(seen, kernel.low()); i < sorted_.size(); ++i, ++tested) {
      const CurvePhoton& photon = *sorted_[i].photon;
      if (photon.at.shape != seen.shape || photon.at.strip != seen.strip || photon.at.uv.x > kernel.high()) break;
      const float irradiance = kernel.irradiance(photon.at, photon.wi);
      if (irradiance > 0) fn(photon, sorted_[i].strands, irradiance, [&] { return groups_.of_light(photon.light); });
    }
    return tested;
  }

 private:
  struct Placed {
    const CurvePhoton* photon;
    const Strand* strands;
  };
  void sort();
  /// Returns the first photon on that strip from u on.
  std::size_t first(const StripPlace& seen, float u) const;

  LightGroups groups_;
  std::vector<Placed> sorted_;  // by strip, then u, then as in the traces
};

}  // namespace dspm
