#include "integrators/photon_grid.h"

#include "core/parallel.h"
#include "integrators/refit.h"

namespace dspm {
namespace {

constexpr std::int64_t kGrain = 1 << 14;

}  // namespace

void PhotonGrid::build(std::span<const Photon* const> photons, float cell_size) {
  const auto count = static_cast<std::int64_t>(photons.size());
  refit(points_, photons.size());
  parallel_for(count, kGrain,
               [&](std::int64_t i) { points_[static_cast<std::size_t>(i)] = photons[static_cast<std::size_t>(i)]->p; });
  grid_.build(points_, cell_size);
  refit(photons_, photons.size());
  parallel_for(count, kGrain, [&](std::int64_t place) {
    const auto i = static_cast<std::size_t>(place);
    const Photon& from = *photons[grid_.order()[i]];
    photons_[i] = {from.wi, from.flux, from.frames};
  });
}

std::size_t PhotonGrid::bytes() const {
  return grid_.bytes() + photons_.capacity() * sizeof(Gathered) + points_.capacity() * sizeof(Vec3);
}

}  // namespace dspm
