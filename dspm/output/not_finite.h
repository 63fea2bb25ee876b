// NaN and infinity: who gave them, and that none reaches a file.
#pragma once

#include "dspm/image/image.h"
#include "dspm/integrators/rejections.h"
#include "dspm/math/frames.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/messages.h"
#include "dspm/world/job.h"
#include "dspm/world/world.h"

namespace dspm {

/// A warning for each part of the interval's scene that gave what is not finite, with the plugin and the first pixel.
void tell(const Rejections& rejections, const World& world, const FrameList& interval, const Job& job,
          Messages& messages);

/// What an integrator lets through becomes black, with a warning. `frame` is one of the file.
void black_out_invalid(Image& image, Frame frame, const Job& job, Messages& messages);

}  // namespace dspm
