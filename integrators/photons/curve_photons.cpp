#include "dspm/integrators/photons/curve_photons.h"

#include <algorithm>
#include <tuple>

namespace dspm {
namespace {

auto key(const StripPlace& place, float u) { return std::tuple(place.shape, place.strip, u); }

}  // namespace

void CurvePhotons::sort() {
  std::stable_sort(sorted_.begin(), sorted_.end(), [](const Placed& a, const Placed& b) {
    return key(a.photon->at, a.photon->at.uv.x) < key(b.photon->at, b.photon->at.uv.x);
  });
}

std::size_t CurvePhotons::first(const StripPlace& seen, float u) const {
  const auto found = std::partition_point(sorted_.begin(), sorted_.end(), [&](const Placed& placed) {
    return key(placed.photon->at, placed.photon->at.uv.x) < key(seen, u);
  });
  return static_cast<std::size_t>(found - sorted_.begin());
}

}  // namespace dspm
