#include "dspm/integrators/photons/hit_point_tile.h"

namespace dspm {

void HitPointTile::start(const Palette& of_iteration) {
  palette = &of_iteration;
  hit_points.clear();
  glossy.clear();
  scatterings.clear();
  strips.clear();
  beams.clear(), steps.clear();
  strands.clear();
  seen.clear();
  radii_in_pixels = 0;
  paths = {}, rejections = {};
}

void account(const std::vector<HitPointTile>& tiles, Statistics& statistics) {
  for (const HitPointTile& tile : tiles) statistics.camera += tile.paths, statistics.rejections += tile.rejections;
}

std::size_t bytes_of(const std::vector<HitPointTile>& tiles) {
  std::size_t sum = 0;
  for (const HitPointTile& tile : tiles)
    sum += (tile.hit_points.capacity() + tile.glossy.capacity()) * sizeof(HitPoint) +
           tile.scatterings.capacity() * sizeof(Scattering) + tile.strips.capacity() * sizeof(HitStrip) +
           tile.beams.capacity() * sizeof(CameraBeam) + tile.steps.capacity() * sizeof(MediumStep) +
           tile.seen.capacity() * sizeof(SeenLight) + tile.strands.bytes();
  return sum;
}

}  // namespace dspm
