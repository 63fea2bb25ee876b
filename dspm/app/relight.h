// The task "relight" of the command line.
#pragma once

#include "dspm/app/options.h"

namespace dspm {

/// Of the options' arguments, those that end with .exr are images, the others factors. The exit code; throws UsageError.
int relight_images(const Options& options);

}  // namespace dspm
