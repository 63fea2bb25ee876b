// NaN, infinity and negative light: reports where they come from, and keeps them out of files.
#pragma once

#include <string>

#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/integrators/output_info.h"
#include "dspm/integrators/rejections.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/job/job.h"
#include "dspm/session/messages.h"
#include "dspm/world/world.h"

namespace dspm {

/// Warns of each element of the interval's scene that gave values that are negative or not finite, with the plugin and
/// the first pixel.
void report_rejections(const Rejections& rejections, const World& world, const FrameList& interval, const Job& job,
                       Messages& messages);

/// Makes such values black, with a warning, if an integrator lets them through into one of its outputs. `frame` is a
/// frame of the file.
void black_out_invalid(Image& image, const OutputInfo& output, FileFrame frame, const Job& job, Messages& messages);

}  // namespace dspm
