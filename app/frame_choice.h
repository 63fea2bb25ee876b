// Which of a file's frames are rendered: --variation and --frames.
#pragma once

#include <vector>

#include "app/options.h"
#include "lang/description.h"

namespace dspm {

/// Ascending. Throws UsageError where an option chooses none, with the names that may have been meant.
std::vector<Frame> chosen_frames(const SceneDescription& description, const Options& options);

}  // namespace dspm
