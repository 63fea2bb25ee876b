#include "dspm/integrators/guiding/visible_beams.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/photons/medium_photons.h"

namespace dspm {
namespace {

struct Gain {
  std::uint32_t photon;
  double squares;
};

CameraBeam widened(CameraBeam beam, float scale, float most) {
  beam.radius *= scale, beam.spread *= scale;
  beam.most = std::min(most, beam.most * scale), beam.least = std::min(beam.most, beam.least * scale);
  return beam;
}

}  // namespace

std::vector<double> squares_in_beams(std::span<const HitPointTile> tiles, const std::vector<PhotonTrace>& traces,
                                     float scale, float most, FrameSet frames) {
  MediumPhotons photons;
  photons.build(traces);
  std::vector<std::vector<Gain>> gains(tiles.size());
  parallel_for(static_cast<std::int64_t>(photons.size() == 0 ? 0 : tiles.size()), 1, [&](std::int64_t t) {
    const HitPointTile& tile = tiles[static_cast<std::size_t>(t)];
    for (const CameraBeam& own : tile.beams) {
      const CameraBeam beam = widened(own, scale, most);
      const FrameSet seen = beam.frames & frames;
      if (seen.empty()) continue;
      const MediumSection section = tile.section_of(beam);
      photons.for_each_along(beam, 1, [&](const auto& found, float distance, float radius2) {
        const FrameSet common = found.photon->frames & seen;
        const float phase = found.photon->phase.pdf_w(found.photon->w, -beam.ray.direction);
        const auto gained = static_cast<double>(tile.palette->luminance(
            beam.throughput * found.photon->flux * section.left_at(distance) * (phase / kernel_size(radius2))));
        if (!common.empty() && gained > 0 && std::isfinite(gained))
          gains[static_cast<std::size_t>(t)].push_back({found.number, common.count() * gained * gained});
      });
    }
  });
  std::vector<double> squares(photons.size());
  for (const std::vector<Gain>& of_tile : gains)
    for (const Gain& gain : of_tile) squares[gain.photon] += gain.squares;
  return squares;
}

}  // namespace dspm
