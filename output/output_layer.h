// Another output of an integrator, in one frame.
#pragma once

#include "dspm/image/image.h"
#include "dspm/integrators/output_info.h"

namespace dspm {

struct OutputLayer {
  OutputInfo info;
  Image image;
};

}  // namespace dspm
