// Which of a file's frames are rendered: --variation and --frames.
#pragma once

#include <vector>

#include "dspm/lang/description.h"
#include "dspm/math/frames.h"
#include "dspm/world/choices.h"

namespace dspm {

/// The same frames of the file as it is now.
std::vector<FileFrame> moved(const std::vector<FileFrame>& frames, const KnownFrames& known, const FileFrames& now);

/// Ascending. Throws UsageError if an option chooses none, with the names that may have been meant.
std::vector<FileFrame> chosen_frames(const SceneDescription& description, const Choices& choices);

}  // namespace dspm
