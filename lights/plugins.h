// The factories of this folder's plugins, one a file.
#pragma once

#include "lights/light.h"

namespace dspm {

MakeLight make_diffuse_area, make_distant, make_infinite, make_point, make_spot;

}  // namespace dspm
