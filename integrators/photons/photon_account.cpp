// Counts what photon traces add to the statistics, and the memory that they take.
#include "dspm/integrators/photons/photon.h"

namespace dspm {

void account(const std::vector<PhotonTrace>& traces, Statistics& statistics) {
  for (const PhotonTrace& trace : traces) {
    statistics.photon += trace.paths;
    statistics.photons_stored += trace.stored;
    statistics.rejections += trace.rejections;
    for (std::size_t f = 0; f < statistics.energy.size(); ++f) statistics.energy[f] += trace.energy[f];
  }
}

std::size_t bytes_of(const std::vector<PhotonTrace>& traces) {
  std::size_t sum = 0;
  for (const PhotonTrace& trace : traces)
    sum += (trace.photons.capacity() + trace.hidden.capacity()) * sizeof(Photon) +
           trace.on_curves.capacity() * sizeof(CurvePhoton) + trace.strands.bytes();
  return sum;
}

}  // namespace dspm
