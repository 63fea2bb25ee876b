// The opening of a thin lens: a circle, or what the blades of an aperture leave of it, which is seen in every highlight out of
// focus.
#pragma once

#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"

namespace dspm {

class Blades {
 public:
  /// Reads "blades", "bladerotation" and "anamorphic". Wrong values are errors, and the opening is a circle.
  explicit Blades(ParamReader& reader);

  /// The numbers for which a round lens has the place that belongs to `u` in the opening; even over its area.
  Vec2 within(Vec2 u) const;

 private:
  int count_;
  float rotation_;        // radians, from x towards y
  float width_, height_;  // of the opening, as shares of the circle's
};

}  // namespace dspm
