// What the camera finds of photons in media while a run learns where photons should start.
#pragma once

#include <span>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/hit_point_tile.h"
#include "dspm/integrators/photons/trace_photons.h"

namespace dspm {

/// Returns for each photon in media, in the order of the traces, the sum over beams and their common frames of the square of
/// the luminance that the beam's pixel gains. Beams have `scale` times their radius, but at most `most`. Strands do not
/// count.
std::vector<double> squares_in_beams(std::span<const HitPointTile> tiles, const std::vector<PhotonTrace>& traces,
                                     float scale, float most, FrameSet frames);

}  // namespace dspm
