// What the projective cameras read, and how they map the screen to the image.
#pragma once

#include <string_view>

#include "dspm/base/math/transform.h"
#include "dspm/base/params/params.h"
#include "dspm/cameras/camera.h"
#include "dspm/cameras/screen.h"
#include "dspm/cameras/thin_lens.h"

namespace dspm {

struct Projection {
  Screen screen;
  ThinLens lens;
};

/// Reads the parameters that the projective cameras share. Wrong values are errors, and their defaults apply.
Projection read_projection(ParamReader& reader, const CameraContext& context);

/// Reads a number that must be above 0; otherwise reports an error and returns the fallback.
float read_positive(ParamReader& reader, std::string_view name, float fallback, std::string_view unit,
                    std::string_view sentence);

/// Maps the screen to the full image: the last step of Camera::image_from_camera().
Matrix4 image_from_screen(const Screen& screen);

/// Reads "shutteropen" and "shutterclose".
void read_shutter(ParamReader& reader);

}  // namespace dspm
