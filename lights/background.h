// What the camera sees behind everything where a light from infinity is to look different there: "rgb background" and
// "float backgroundblur" of an infinite light. The light itself, and what mirrors and glass show of it, stay as they
// are.
#pragma once

#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/sphere_mapping.h"
#include "dspm/base/params/params.h"
#include "dspm/image/image.h"
#include "dspm/lights/environment_map.h"

namespace dspm {

struct BackgroundChoice {
  std::optional<Rgb> colour;
  float blur = 0;  // degrees; 0: none
};

BackgroundChoice read_background(ParamReader& reader);

/// The picture by directions, convolved with a Gaussian over the sphere: `sigma` in degrees.
EnvironmentMap blurred(const Image& image, SphereMapping mapping, float sigma);

/// In light space, times its own scale.
struct Background {
  EnvironmentMap map;
  float scale = 1;
};

}  // namespace dspm
