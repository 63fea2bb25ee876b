#include "dspm/integrators/photons/gather.h"

namespace dspm {

void account(std::span<const GatherCounts> tiles, Statistics& statistics) {
  for (const GatherCounts& c : tiles) {
    statistics.gathers += c.gathers, statistics.photon_tests += c.tests, statistics.photons_found += c.found;
    statistics.rejections += c.rejections;
  }
}

}  // namespace dspm
