#include "integrators/photon_map.h"

#include "core/parallel.h"
#include "integrators/refit.h"

namespace dspm {

void PhotonMap::build(const std::vector<PhotonTrace>& traces, float cell_size) {
  std::vector<std::size_t> begin(traces.size() + 1, 0);
  for (std::size_t t = 0; t < traces.size(); ++t) begin[t + 1] = begin[t] + traces[t].photons.size();
  refit(points_, begin.back());
  std::vector<const Photon*> photon(begin.back());
  parallel_for(static_cast<std::int64_t>(traces.size()), 1, [&](std::int64_t trace) {
    const auto t = static_cast<std::size_t>(trace);
    for (std::size_t i = 0; i < traces[t].photons.size(); ++i) {
      photon[begin[t] + i] = &traces[t].photons[i];
      points_[begin[t] + i] = traces[t].photons[i].p;
    }
  });
  grid_.build(points_, cell_size);
  refit(photons_, begin.back());
  parallel_for(static_cast<std::int64_t>(photons_.size()), 1 << 14, [&](std::int64_t place) {
    const auto i = static_cast<std::size_t>(place);
    const Photon& from = *photon[grid_.order()[i]];
    photons_[i] = {from.wi, from.flux, from.frames};
  });
}

std::size_t PhotonMap::bytes() const {
  return grid_.bytes() + photons_.capacity() * sizeof(Gathered) + points_.capacity() * sizeof(Vec3);
}

}  // namespace dspm
