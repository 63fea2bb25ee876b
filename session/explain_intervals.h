// What frames share, in a render whose frames are rendered in several intervals.
#pragma once

#include <string>
#include <vector>

#include "dspm/session/frame_intervals.h"
#include "dspm/world/world.h"

namespace dspm {

/// One sentence each, for --explain: what holds in all intervals once, then what is different in some of them.
std::vector<std::string> explain_intervals(const World& world, const std::vector<FrameList>& intervals);

}  // namespace dspm
