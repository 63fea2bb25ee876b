// The factories of this folder's plugins, one a file.
#pragma once

#include "cameras/camera.h"

namespace dspm {

MakeCamera make_orthographic, make_perspective;

}  // namespace dspm
