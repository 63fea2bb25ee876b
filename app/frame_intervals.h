// How the frames of a run are cut up where not all are rendered together.
#pragma once

#include <span>
#include <vector>

#include "core/frames.h"

namespace dspm {

/// Consecutive intervals of equal length (the last may be shorter), of at most `together` frames.
std::vector<std::span<const Frame>> cut_into_intervals(std::span<const Frame> frames, int together);

}  // namespace dspm
