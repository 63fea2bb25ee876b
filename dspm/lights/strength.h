// "scale", and "power" or "illuminance": how strong a light is next to what its "I", "L" or image says.
#pragma once

#include "dspm/params/params.h"

namespace dspm {

struct Strength {
  float scale = 1;
  float target = -1;  // lm or lx; not above 0: not given

  /// What I, L or the image is to be multiplied by, where of itself, at luminance 1, it would make `unscaled` lm or lx.
  float factor(float unscaled) const { return target > 0 && unscaled > 0 ? scale * target / unscaled : scale; }
};

Strength read_power(ParamReader& reader);
Strength read_illuminance(ParamReader& reader);

}  // namespace dspm
