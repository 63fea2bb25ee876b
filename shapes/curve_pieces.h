// Cuts segments of curves into the pieces that trees bound.
#pragma once

#include <cstdint>
#include <span>

#include "dspm/base/system/untouched.h"
#include "dspm/shapes/curve_segment.h"

namespace dspm {

/// Cuts segment s into up to 2^split_depths[s] pieces. Those that lie close together are stored close together,
/// whatever the order of the segments: a ray that passes dense hair waits for memory more than for anything else.
UntouchedVector<CurvePiece> cut_into_pieces(std::span<const CurveSegment> segments,
                                            std::span<const std::uint8_t> split_depths);

}  // namespace dspm
