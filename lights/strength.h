// "scale", and "power" or "illuminance": the strength of a light relative to its "I", "L" or image.
#pragma once

#include "dspm/base/params/params.h"

namespace dspm {

struct Strength {
  float scale = 1;
  float target = -1;  // lm or lx; not above 0: not given

  /// Returns the factor for I, L or the image, which by itself, at luminance 1, would give `unscaled` lm or lx.
  float factor(float unscaled) const { return target > 0 && unscaled > 0 ? scale * target / unscaled : scale; }
};

Strength read_power(ParamReader& reader);
Strength read_illuminance(ParamReader& reader);

}  // namespace dspm
