// Files that are not there yet, for frames that are not rendered: a simulation may still be writing its cache.
#pragma once

#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/description.h"

namespace dspm {

/// Fills gaps in numbered sequences, because sampling derives what it derives from all frames of the file. If a file is
/// missing in a frame that is not rendered, that frame takes the file before it, and a note says so.
void hold_missing_files(SceneDescription& description, const std::vector<FileFrame>& rendered,
                        Diagnostics& diagnostics);

}  // namespace dspm
