// Plans how machines can share a render out: parts of the iterations, of the frames, or of both.
#pragma once

#include <string>

#include "dspm/session/load.h"

namespace dspm {

/// Returns a table of the ways for that many machines, and for one, with the time and memory of a part on machines like
/// this one, from two iterations of each way's largest part. `loading` is the time that the scene took, in seconds.
/// Throws UsageError if the render has no end, or there is no way.
std::string plan_parts(const LoadedScene& loaded, double loading, int machines, Messages& messages);

}  // namespace dspm
