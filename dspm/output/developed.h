// From radiance to the values in files.
#pragma once

#include "dspm/image/image.h"
#include "dspm/world/job.h"

namespace dspm {

/// Exposed and balanced as the film says, but without its limit.
Image exposed(Image image, const Job& job);
/// With that limit.
Image developed(Image image, const Job& job);

}  // namespace dspm
