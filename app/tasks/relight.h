// The task "relight" of the command line.
#pragma once

#include "dspm/app/options/options.h"

namespace dspm {

/// Relights images: arguments that end with .exr are images, the others factors. Returns the exit code; throws
/// UsageError.
int relight_images(const Options& options);

}  // namespace dspm
