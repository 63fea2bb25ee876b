// The tasks for images that exist.
#pragma once

#include "dspm/app/options/options.h"

namespace dspm {

/// Returns whether all scenes on the command line are images: then --sheet and --video show these.
bool are_images(const Options& options);
/// Carries out --compare, --flicker, --sheet and --video of images. Throws UsageError, std::runtime_error.
void look_at_images(const Options& options);

}  // namespace dspm
